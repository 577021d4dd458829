# angen_add_plugin(NAME sources...): a plug-in library libNAME.so for Angen, in the caller's own package.
# Comes with find_package(angen_sim); see docs/plugins.md.
find_package(Eigen3 REQUIRED NO_MODULE)

function(angen_add_plugin name)
  add_library(${name} MODULE ${ARGN})
  target_compile_features(${name} PRIVATE cxx_std_17)
  target_include_directories(${name} SYSTEM PRIVATE ${angen_sim_INCLUDE_DIRS})
  # A function that is missing is found when the library is linked or loaded, not in the middle of a run; and a
  # class is the library's own, also when another library has one of the same name.
  target_link_options(${name} PRIVATE -Wl,--as-needed -Wl,-z,defs -Wl,-z,now -Wl,-Bsymbolic)
  target_link_libraries(${name} PRIVATE ${angen_sim_LIBRARIES} angen_class_loader Eigen3::Eigen)
endfunction()
