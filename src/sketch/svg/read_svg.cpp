#include "lascaux/sketch/read_svg.h"

#include "sketch/svg/document.h"
#include "sketch/svg/drawing.h"

namespace lascaux {

Outcome<Sketch> ReadSvg(std::string_view bytes, const ReadSvgOptions& options) {
  const Outcome<svg::Document> document = svg::Document::Load(bytes, options);
  if (!document) return Outcome<Sketch>::Failure(document.diagnostics());
  return svg::ReadDrawing(*document, options);
}

}  // namespace lascaux
