# Debian 12's quirks, each with its reason. Repeated for consumers in lascauxConfig.cmake.in.

find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Boost 1.74 REQUIRED)
# TBB before OpenVDB: its find module looks for an older TBB by itself and stops.
find_package(TBB REQUIRED CONFIG)
# OpenVDB has a find module of its own, in a folder known only after project().
list(APPEND CMAKE_MODULE_PATH ${CMAKE_INSTALL_PREFIX}/lib/cmake/OpenVDB
     /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)
find_package(OpenVDB 10 REQUIRED)
# FindOpenVDB switches this on for everybody who comes after it.
set(BUILD_SHARED_LIBS OFF)
find_package(fmt 9 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(pugixml REQUIRED)
find_package(CGAL 5.5 REQUIRED QUIET)
find_package(PkgConfig REQUIRED)
pkg_check_modules(lib2geom REQUIRED IMPORTED_TARGET 2geom)
