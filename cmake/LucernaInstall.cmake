# cmake --install: an installation finds its parts relative to one another, so it may be moved.
# Shaders and pipelines are compiled into the library; their texts are installed to read and to copy.
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Lucerna)
set(data_folder ${CMAKE_INSTALL_DATADIR}/lucerna)

# lucerna_find_library_from(TARGET FOLDER): an installed program in FOLDER looks for liblucerna where it
# stands relative to it.
function(lucerna_find_library_from target folder)
  file(RELATIVE_PATH way ${folder} ${CMAKE_INSTALL_FULL_LIBDIR})
  set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN/${way}")
endfunction()
lucerna_find_library_from(lucerna ${CMAKE_INSTALL_FULL_BINDIR})
lucerna_find_library_from(lucerna_worker ${CMAKE_INSTALL_FULL_LIBEXECDIR}/lucerna)

install(TARGETS lucerna)
install(TARGETS lucerna_worker DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/lucerna)
install(TARGETS liblucerna EXPORT LucernaTargets
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lucerna)
install(EXPORT LucernaTargets NAMESPACE Lucerna:: DESTINATION ${package_folder})

configure_package_config_file(cmake/LucernaConfig.cmake.in LucernaConfig.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(LucernaConfigVersion.cmake COMPATIBILITY ExactVersion)
install(FILES ${PROJECT_BINARY_DIR}/LucernaConfig.cmake ${PROJECT_BINARY_DIR}/LucernaConfigVersion.cmake
  DESTINATION ${package_folder})

file(RELATIVE_PATH way ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(cmake/lucerna.pc.in lucerna.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/lucerna.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

get_property(shaders GLOBAL PROPERTY LUCERNA_SHADERS)
list(FILTER shaders EXCLUDE REGEX "test_shaders/")
list(REMOVE_DUPLICATES shaders)
foreach(shader IN LISTS shaders)
  cmake_path(GET shader PARENT_PATH folder)
  install(FILES src/${shader} DESTINATION ${data_folder}/shaders/${folder})
endforeach()
install(DIRECTORY pipelines DESTINATION ${data_folder})
