#pragma once

#include <filesystem>
#include <vector>

#include "lascaux/base/diagnostic.h"
#include "lascaux/volume/picture.h"
#include "output_plan.h"

namespace lascaux {

/// A picture and the file that it belongs in.
struct PictureFile {
  std::filesystem::path path;
  Picture picture;
};

/// The files of several pictures (at least one) for a name: one sheet, or where the name has a run
/// of '#' one file a picture, the run replaced by its number from 1, filled up with zeros.
/// `columns` of the sheet; 0 makes it about as wide as high.
std::vector<PictureFile> PicturesOf(const std::vector<Picture>& pictures,
                                    const OutputTarget& target, int columns);

/// Writes a picture in the format that is asked for. Errors: those of WritePng().
Diagnostics WritePicture(const std::filesystem::path& path, const Picture& picture,
                         OutputKind kind);

}  // namespace lascaux
