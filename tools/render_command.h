#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "exit_code.h"
#include "lascaux/base/execution.h"
#include "lascaux/volume/render_options.h"
#include "messages.h"

namespace lascaux {

/// What shares a sheet: the pictures of each model, or those of all models of a call.
enum class Sheet : std::uint8_t { kOfEachModel, kOfAllModels };

/// What `lascaux render` is told on the command line.
struct RenderCommandOptions {
  std::vector<std::string> models;   ///< paths, "-" for standard input
  std::vector<std::string> outputs;  ///< values of -o
  std::string format;                ///< "png" or "exr", whatever the outputs' endings; or empty
  std::string grid;                  ///< name of the level set; empty: "surface" or the first
  std::vector<View> views;           ///< empty: three-quarter, for a contact sheet all four
  int turntable = 0;                 ///< pictures of a whole turn; 0: no turn
  bool contact_sheet = false;
  int columns = 0;       ///< of a sheet; 0: about as wide as high
  RenderOptions render;  ///< of each picture
  Verbosity verbosity = Verbosity::kAll;
};

/// Draws the models and writes the pictures; says on standard error what there is to say.
///
/// Several pictures (views, a turn) that go to one file become a sheet; a name with #### gets each
/// in a file of its own, numbered from 1. All files of a model appear, or none.
/// Returns the worst exit code; nothing is begun when the command line is wrong.
ExitCode RunRender(const RenderCommandOptions& options, const Execution& execution);

}  // namespace lascaux
