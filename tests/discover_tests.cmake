# Runs after a test program is linked: writes a script that tells ctest of each of its cases.
#   cmake -D PROGRAM=FILE -D NAME=NAME -D FOLDERS=FOLDER,... -D PROPERTIES=... -D SCRIPT=FILE -P discover_tests.cmake
# A case has the labels of the folders that the program covers, and one of these: quick without a tag, slow with
# [slow], and slow as well as campaign with [slow][campaign], which is longer under REMAP_CAMPAIGN=full.
#
# Names are kept in lists, so that semicolons and brackets are replaced while they are there.
cmake_minimum_required(VERSION 3.25)

function(list_cases result)
  execute_process(COMMAND ${PROGRAM} ${ARGN} --list-test-names-only OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  string(REPLACE ";" "<semicolon>" names "${output}")
  string(REPLACE "[" "<open>" names "${names}")
  string(REPLACE "]" "<close>" names "${names}")
  string(REPLACE "\n" ";" names "${names}")
  list(REMOVE_ITEM names "")
  set(${result} ${names} PARENT_SCOPE)
endfunction()

list_cases(names)
list_cases(slow_names "[slow]")
list_cases(campaign_names "[campaign]")
if(NOT names)
  message(FATAL_ERROR "${PROGRAM} lists no test case")
endif()
string(REPLACE "," ";" folders "${FOLDERS}")
get_filename_component(working_folder ${SCRIPT} DIRECTORY)

set(script "")
foreach(name IN LISTS names)
  if(name IN_LIST campaign_names)
    set(speed slow campaign)
  elseif(name IN_LIST slow_names)
    set(speed slow)
  else()
    set(speed quick)
  endif()
  string(REPLACE "<semicolon>" ";" name "${name}")
  string(REPLACE "<open>" "[" name "${name}")
  string(REPLACE "<close>" "]" name "${name}")
  string(REGEX REPLACE "([],[])" "\\\\\\1" pattern "${name}")  # commas and brackets are operators of Catch2
  string(APPEND script
    "add_test([==[${NAME}: ${name}]==] [==[${PROGRAM}]==] [==[${pattern}]==])\n"
    "set_tests_properties([==[${NAME}: ${name}]==] PROPERTIES WORKING_DIRECTORY [==[${working_folder}]==] "
    "SKIP_RETURN_CODE 77 LABELS [==[${speed};${folders}]==] ${PROPERTIES})\n")
endforeach()
file(WRITE ${SCRIPT} "${script}")
