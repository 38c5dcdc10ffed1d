# SPDX-License-Identifier: Apache-2.0
# `cmake --install`: headers, the two libraries, the program with what belongs to it, and what other projects
# need to find them: limberConfig.cmake (targets limber::player and limber::limber), limber-player.pc, limber.pc.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# What liblimber.a may be linked with: the target, how limberConfig.cmake finds it, and how limber.pc names it
# (a package where the distribution has one, else the library). Static libraries pass on what they need, so the
# table must be complete; a target that is missing here stops the configuration.
set(limber_known_dependencies
    "fmt::fmt|fmt|fmt|"
    "TBB::tbb|TBB|tbb|"
    "Threads::Threads|Threads||-pthread"
    "embree|embree||-lembree3"
    "meshoptimizer::meshoptimizer|meshoptimizer||-lmeshoptimizer"
    "nlohmann_json::nlohmann_json|nlohmann_json||"
    "PNG::PNG|PNG|libpng|")

set(limber_find_dependencies "")
set(limber_pc_requires "limber-player = ${PROJECT_VERSION}")
set(limber_pc_libs "")
get_target_property(linked limber LINK_LIBRARIES)
list(FILTER linked EXCLUDE REGEX "^::@")  # marks the folder that linked what follows
list(REMOVE_DUPLICATES linked)
foreach(target IN LISTS linked)
  if(target STREQUAL "limber_player" OR target STREQUAL "limber::player")
    continue()
  endif()
  set(found FALSE)
  foreach(row IN LISTS limber_known_dependencies)
    string(REPLACE "|" ";" row "${row}")
    list(GET row 0 name)
    if(NOT name STREQUAL target)
      continue()
    endif()
    set(found TRUE)
    list(GET row 1 package)
    list(GET row 2 pc)
    list(GET row 3 libs)
    string(APPEND limber_find_dependencies "find_dependency(${package})\n")
    if(pc)
      string(APPEND limber_pc_requires ", ${pc}")
    endif()
    if(libs)
      string(APPEND limber_pc_libs " ${libs}")
    endif()
  endforeach()
  if(NOT found)
    message(FATAL_ERROR "limber is linked with ${target}: add it to the table in cmake/Install.cmake, so that "
                        "projects that use an installed limber find it")
  endif()
endforeach()

set_target_properties(limber_player PROPERTIES EXPORT_NAME player)
install(TARGETS limber_player limber EXPORT limberTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/limber ${PROJECT_BINARY_DIR}/include/limber
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
if(TARGET limber_tool)
  install(TARGETS limber_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  # The man page and the completions, where the build has made them: man/man1/limber.1,
  # bash-completion/completions/limber, zsh/site-functions/_limber, fish/vendor_completions.d/limber.fish.
  install(DIRECTORY ${PROJECT_BINARY_DIR}/share/ DESTINATION ${CMAKE_INSTALL_DATADIR} OPTIONAL)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/limber)
install(EXPORT limberTargets NAMESPACE limber:: DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/limberConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/package/limberConfig.cmake INSTALL_DESTINATION ${package_dir}
                              NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/limberConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/limberConfig.cmake ${PROJECT_BINARY_DIR}/package/limberConfigVersion.cmake
        DESTINATION ${package_dir})

# Relative to where the .pc file lies, so that an installed tree can be moved.
file(RELATIVE_PATH limber_pc_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" limber_pc_prefix "${limber_pc_prefix}")
foreach(name limber limber-player)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/${name}.pc.in ${PROJECT_BINARY_DIR}/package/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/package/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()
