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
  const auto library = [&text](const char* name, const std::string& version) {
    text += fmt::format("  {} {}\n", name, version);
  };
  library("OpenVDB", OPENVDB_LIBRARY_VERSION_STRING);
  library("oneTBB", fmt::format("{}.{}", TBB_VERSION_MAJOR, TBB_VERSION_MINOR));
  library("CGAL", CGAL_VERSION_STR);
  library("OpenImageIO", OIIO_VERSION_STRING);
  library("Eigen",
          fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION));
  library("Boost", fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000,
                               BOOST_VERSION % 100));
  library("pugixml", fmt::format("{}.{}", PUGIXML_VERSION / 1000, PUGIXML_VERSION / 10 % 100));
  library("CLI11", CLI11_VERSION);
  library("nlohmann-json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR,
                                       NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH));
  library("fmt",
          fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100));
  return text;
}

}  // namespace lascaux
