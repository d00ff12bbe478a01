#include "version.h"

#include <CGAL/version.h>
#include <OpenImageIO/oiioversion.h>
#include <fmt/format.h>
#include <openvdb/version.h>
#include <tbb/version.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <boost/version.hpp>
#include <nlohmann/detail/macro_scope.hpp>
#include <pugixml.hpp>

namespace lascaux {

std::string VersionText() {
  std::string text = fmt::format("lascaux {}\n", kVersion);
  const auto add = [&text](const char* name, const std::string& version) {
    text += fmt::format("  {} {}\n", name, version);
  };
  add("OpenVDB", OPENVDB_LIBRARY_VERSION_STRING);
  add("oneTBB", fmt::format("{}.{}", TBB_VERSION_MAJOR, TBB_VERSION_MINOR));
  add("CGAL", CGAL_VERSION_STR);
  add("OpenImageIO", OIIO_VERSION_STRING);
  add("Eigen",
      fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION));
  add("Boost", fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000,
                           BOOST_VERSION % 100));
  add("pugixml", fmt::format("{}.{}", PUGIXML_VERSION / 1000, PUGIXML_VERSION / 10 % 100));
  add("CLI11", CLI11_VERSION);
  add("nlohmann-json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR,
                                   NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH));
  add("fmt",
      fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100));
  return text;
}

}  // namespace lascaux
