#pragma once

#include <string_view>

#include "lascaux/base/outcome.h"
#include "run_pipeline.h"

/// @file
/// The file of --overrides: what a person knows better than the rules (docs/overrides.md).

namespace lascaux {

/// The options with what `text`, a document of the format lascaux.overrides/1, says: strokes to
/// ignore, limbs to cut off, the body, and what parts are. A body that the options name already
/// stays. Whether strokes and parts are there is for the stages to say.
///
/// Error (input): "bad-overrides", with the field and what it has to be.
Outcome<PipelineOptions> WithOverrides(PipelineOptions options, std::string_view text);

}  // namespace lascaux
