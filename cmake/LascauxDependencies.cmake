# Debian 12's quirks, each with its reason. Repeated for consumers in lascauxConfig.cmake.in.

find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Boost 1.74 REQUIRED)
# TBB before OpenVDB: its find module looks for an older TBB by itself and stops.
find_package(TBB REQUIRED CONFIG)
# OpenVDB has a find module of its own, in a folder known only after project().
list(APPEND CMAKE_MODULE_PATH ${CMAKE_INSTALL_PREFIX}/lib/cmake/OpenVDB
     /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)
# Debian's Imath names a Python library that libopenvdb-dev does not need and says so at length, so only warnings are heard.
set(lascaux_log_level ${CMAKE_MESSAGE_LOG_LEVEL})
set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
find_package(OpenVDB 10 REQUIRED)
set(CMAKE_MESSAGE_LOG_LEVEL ${lascaux_log_level})
# FindOpenVDB switches this on for everybody who comes after it.
set(BUILD_SHARED_LIBS OFF)
find_package(fmt 9 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(pugixml REQUIRED)
find_package(CGAL 5.5 REQUIRED QUIET)
find_package(PNG 1.6 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(lib2geom REQUIRED IMPORTED_TARGET 2geom)
pkg_check_modules(minizip REQUIRED IMPORTED_TARGET minizip)
pkg_check_modules(jemalloc REQUIRED IMPORTED_TARGET jemalloc)
find_package(OpenImageIO 2.4 REQUIRED CONFIG)
# Debian's target names a folder of OpenCV that its package does not bring, at which CMake stops.
get_target_property(oiio_includes OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
list(REMOVE_ITEM oiio_includes /usr/include/opencv4)
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${oiio_includes}")
