#include <future>

#include "grid_plugin.h"
#include "lascaux/io/load_plugin.h"

namespace lascaux {
namespace {

Outcome<const GridPlugin*> Load() {
  using Result = Outcome<const GridPlugin*>;
  Diagnostics log;
  const auto symbol =
      LoadPlugin({.file = "lascaux_grid.so", .symbol = "lascaux_grid_plugin"}).MoveInto(log);
  if (!symbol) return Result::Failure(std::move(log));
  return static_cast<const GridPlugin*>(*symbol);
}

/// Loading, from when somebody first asks for it.
const std::shared_future<Outcome<const GridPlugin*>>& Loading() {
  static const std::shared_future<Outcome<const GridPlugin*>> loading =
      std::async(std::launch::async, Load);
  return loading;
}

}  // namespace

void PreloadGridPlugin() { Loading(); }

const Outcome<const GridPlugin*>& LoadGridPlugin() { return Loading().get(); }

}  // namespace lascaux
