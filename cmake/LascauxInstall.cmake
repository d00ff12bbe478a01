# Headers, libraries and a package that find_package(lascaux) finds.

include(CMakePackageConfigHelpers)

get_property(lascaux_modules GLOBAL PROPERTY LASCAUX_MODULES)
set(lascaux_package ${CMAKE_INSTALL_LIBDIR}/cmake/lascaux)

install(TARGETS ${lascaux_modules} EXPORT lascauxTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/lascaux DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT lascauxTargets NAMESPACE lascaux:: DESTINATION ${lascaux_package})

# File managers: what a .vdb is, and how it looks.
install(DIRECTORY share/ DESTINATION ${CMAKE_INSTALL_DATADIR})

configure_package_config_file(cmake/lascauxConfig.cmake.in lascauxConfig.cmake
                              INSTALL_DESTINATION ${lascaux_package})
# Fields are added before version 1, and sometimes changed.
write_basic_package_version_file(lascauxConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/lascauxConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/lascauxConfigVersion.cmake DESTINATION ${lascaux_package})
