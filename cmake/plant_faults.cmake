# Copies the sources and plants every fault of tests/mutation/faults.toml in the copy
# (docs/how_to/mutants.md), again whenever a source changes.
set(OCTOCELL_SOURCES ${PROJECT_BINARY_DIR}/planted)
find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter)
execute_process(
  COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/tests/mutation/plant.py ${OCTOCELL_SOURCES}
  RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "the faults could not be planted")
endif()
set(patterns "")
file(GLOB folders ${PROJECT_SOURCE_DIR}/*/CMakeLists.txt)
list(APPEND folders ${PROJECT_SOURCE_DIR}/include/CMakeLists.txt)
foreach(suffix cpp hpp cu cuh txt)
  list(TRANSFORM folders REPLACE "/CMakeLists.txt$" "/*.${suffix}" OUTPUT_VARIABLE more)
  list(APPEND patterns ${more})
endforeach()
file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${patterns} ${PROJECT_SOURCE_DIR}/tests/mutation/*.toml)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${sources})
