#include "picture_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <string>

#include "lascaux/io/write_exr.h"
#include "lascaux/io/write_png.h"

namespace lascaux {

std::vector<PictureFile> PicturesOf(const std::vector<Picture>& pictures,
                                    const OutputTarget& target, int columns) {
  const std::string name = target.path.filename().string();
  const std::size_t begin = name.find('#');
  if (begin == std::string::npos) {
    if (pictures.size() == 1) return {{target.path, pictures[0]}};
    const int across = columns > 0 ? columns : SheetColumns(static_cast<int>(pictures.size()));
    return {{target.path, ArrangePictures(pictures, across)}};
  }
  const std::size_t end = std::min(name.find_first_not_of('#', begin), name.size());
  std::vector<PictureFile> files;
  for (const Picture& picture : pictures) {
    const std::string number = fmt::format("{:0{}}", files.size() + 1, end - begin);
    files.push_back(
        {target.path.parent_path() / (name.substr(0, begin) + number + name.substr(end)), picture});
  }
  return files;
}

Diagnostics WritePicture(const std::filesystem::path& path, const Picture& picture,
                         OutputKind kind) {
  if (kind == OutputKind::kExr) return WriteExr(path, picture);
  assert(kind == OutputKind::kPng);
  return WritePng(path, ToImage(picture));
}

}  // namespace lascaux
