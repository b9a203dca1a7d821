# Installs a build of gaussmesh to a fresh folder, then configures, builds and runs two projects against it: the
# consumer, and the example of the README as it stands there.
#
#   cmake -D BUILD_DIR=... -D SOURCE_DIR=... -D WORK_DIR=... -D CONFIG=... -D COMPILER=... -P run.cmake
file(REMOVE_RECURSE "${WORK_DIR}")

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${ARGN}")
  endif()
endfunction()

# Builds the project in `source` and runs its program with the other arguments.
function(build_and_run name source)
  run("${CMAKE_COMMAND}" -S "${source}" -B "${WORK_DIR}/${name}" "-DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix"
      "-DCMAKE_BUILD_TYPE=${CONFIG}" "-DCMAKE_CXX_COMPILER=${COMPILER}")
  run("${CMAKE_COMMAND}" --build "${WORK_DIR}/${name}" --config "${CONFIG}")
  find_program(${name} ${name} PATHS "${WORK_DIR}/${name}" "${WORK_DIR}/${name}/${CONFIG}" NO_DEFAULT_PATH REQUIRED)
  run("${${name}}" ${ARGN})
endfunction()

# Writes the first block of that language in the README to a file of the example.
function(write_block language file)
  file(READ "${SOURCE_DIR}/../../README.md" readme)
  if(NOT readme MATCHES "```${language}\n([^`]*)```")
    message(FATAL_ERROR "no block of ${language} in README.md")
  endif()
  file(WRITE "${WORK_DIR}/readme/${file}" "${CMAKE_MATCH_1}")
endfunction()

run("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${WORK_DIR}/prefix" --config "${CONFIG}")
build_and_run(consumer "${SOURCE_DIR}")
if(EXISTS "${WORK_DIR}/prefix/bin/gaussmesh")  # the batch program finds the one that it was installed with
  run("${WORK_DIR}/prefix/bin/gaussmesh-batch" "${SOURCE_DIR}/../../data/methanol.pqr" --output "${WORK_DIR}/meshes")
endif()
write_block(cmake CMakeLists.txt)
write_block(cpp main.cpp)
build_and_run(example "${WORK_DIR}/readme" "${SOURCE_DIR}/../../data/methanol.pqr" "${WORK_DIR}/example/mesh.vtp")
