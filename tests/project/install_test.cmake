# Installs the build into a scratch prefix, builds docs/examples/newcomers against it and runs it: it must evolve what
# lore-evolve does. Then a world in C, compiled against the installed header, and one in Python: they keep their
# contract. The installed `lore` knows the installed jobs.
set(scratch ${BUILD}/install-test)
file(REMOVE_RECURSE ${scratch})

function(run result_variable)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${output}${errors}")
  endif()
  set(${result_variable} "${output}${errors}" PARENT_SCOPE)
endfunction()

run(output ${CMAKE_COMMAND} --install ${BUILD} --prefix ${scratch}/prefix)
run(overview ${scratch}/prefix/bin/lore)
if(NOT overview MATCHES "cp -r ${scratch}/prefix/share/lore/jobs")
  message(FATAL_ERROR "lore does not say where the jobs are:\n${overview}")
endif()
run(output ${scratch}/prefix/share/lore/jobs/quickstart --help)
run(output ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${scratch}/prefix/lib/pkgconfig:${scratch}/prefix/lib64/pkgconfig
  pkg-config --print-errors --cflags lore)
if(NOT output MATCHES "-I${scratch}/prefix/[^ ]*/include ")
  message(FATAL_ERROR "lore.pc does not say where the headers are: ${output}")
endif()
run(output ${CMAKE_COMMAND} -S ${SOURCE}/docs/examples/newcomers -B ${scratch}/build
  -DCMAKE_PREFIX_PATH=${scratch}/prefix
    -DCMAKE_CXX_COMPILER=${CXX} "-DCMAKE_CXX_FLAGS=${FLAGS}")
run(output ${CMAKE_COMMAND} --build ${scratch}/build)

file(COPY ${scratch}/prefix/share/lore/examples/pendulum DESTINATION ${scratch})
run(output cc -std=c99 -pedantic -Wall -Werror -O2 -ffp-contract=off -shared -fPIC -I${scratch}/prefix/include
  ${scratch}/pendulum/pendulum.c -o ${scratch}/pendulum/pendulum.so -lm)
run(output ${scratch}/prefix/bin/lore-world check --steps 100 --config ${scratch}/pendulum/source.toml)

file(COPY ${scratch}/prefix/share/lore/examples/cartpole DESTINATION ${scratch})
get_filename_component(python_folder ${PYTHON} DIRECTORY)   # of the one that has numpy
run(output ${CMAKE_COMMAND} -E env PATH=${python_folder}:$ENV{PATH}
  ${scratch}/prefix/bin/lore-world check --steps 100 --config ${scratch}/cartpole/source.toml)

set(settings evolution.generations=3 evolution.population=20 evolution.founders=40 evolution.ties=older
  episode.steps=200)
run(example ${scratch}/build/newcomers ${SOURCE}/jobs/tasks/source.toml 7 ${settings})
list(TRANSFORM settings PREPEND "--set;" OUTPUT_VARIABLE options)
run(program ${scratch}/prefix/bin/lore-evolve ${SOURCE}/jobs/tasks/source.toml --seed 7 --out ${scratch}/run ${options})

foreach(output example program)
  string(REGEX MATCH "signature: [0-9a-f]+" ${output}_signature "${${output}}")
endforeach()
if(NOT example_signature OR NOT example_signature STREQUAL program_signature)
  message(FATAL_ERROR "the example evolves something else than lore-evolve:\n${example}\n${program}")
endif()
if(NOT example MATCHES "generation,newcomers,tied,fronts\n0,20,[^\n]*\n1,[0-9]+,[^\n]*\n2,[^\n]*\n3,")
  message(FATAL_ERROR "the example's rows are not what they should be:\n${example}")
endif()
