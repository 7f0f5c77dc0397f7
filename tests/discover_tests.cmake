# This script runs after a test program is linked. It writes a script that declares its cases to ctest.
#
#   cmake -D PROGRAM=FILE -D NAME=NAME -D FOLDERS=FOLDER,... -D PROPERTIES=... -D SCRIPT=FILE -P discover_tests.cmake
#
# The cases of a file that have neither [slow] nor [needs] are one test with the label quick, because starting a
# program that links OpenImageIO takes a quarter of a second of processor time. Every other case is a separate test,
# with these labels: quick with [needs], which marks a case that may be skipped; slow with [slow]; slow and campaign
# with [slow][campaign], which takes longer under REMAP_CAMPAIGN=full. Another label of a test is the folder of
# sources that its file mirrors (tests/compiler/table mirrors compiler/table), or FOLDERS if it mirrors none. ctest
# starts slow tests first, by their COST, so that quick ones fill the processors at the end.
#
# Names are kept in lists, so semicolons and brackets are replaced as long as they are there.
cmake_minimum_required(VERSION 3.22)

# The output has lines "file<tab>tags<tab>name", with a space before and after each tag.
execute_process(COMMAND ${PROGRAM} --list-for-ctest OUTPUT_VARIABLE cases COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE ";" "<semicolon>" cases "${cases}")
string(REPLACE "[" "<open>" cases "${cases}")
string(REPLACE "]" "<close>" cases "${cases}")
string(REGEX REPLACE "\n$" "" cases "${cases}")
string(REPLACE "\n" ";" cases "${cases}")
if(NOT cases)
  message(FATAL_ERROR "${PROGRAM} lists no test case")
endif()
get_filename_component(working_folder ${SCRIPT} DIRECTORY)
set(script "")

# add(NAME LABELS ARGUMENTS) adds a test of this program. ARGUMENTS is one text, [==[ARGUMENT]==] with spaces between
# them, because a name may contain semicolons.
function(add name labels arguments)
  set(cost 0)
  if(labels MATCHES "slow")
    set(cost 10)
  endif()
  string(APPEND script
    "add_test([==[${NAME}: ${name}]==] [==[${PROGRAM}]==] ${arguments})\n"
    "set_tests_properties([==[${NAME}: ${name}]==] PROPERTIES WORKING_DIRECTORY [==[${working_folder}]==] "
    "SKIP_RETURN_CODE 77 COST ${cost} LABELS [==[${labels}]==] ${PROPERTIES})\n")
  set(script "${script}" PARENT_SCOPE)
endfunction()

set(quick_files "")
foreach(case IN LISTS cases)
  string(REGEX MATCH "^([^\t]*)\t([^\t]*)\t(.*)$" matched "${case}")
  set(tags "${CMAKE_MATCH_2}")
  set(name "${CMAKE_MATCH_3}")
  string(REGEX REPLACE "^(.*/)?tests/(.*)\\.cpp$" "\\2" file "${CMAKE_MATCH_1}")
  if(file MATCHES "^((compiler|runtime)/.*)/")
    set(folders ${CMAKE_MATCH_1})
  else()
    string(REPLACE "," ";" folders "${FOLDERS}")
  endif()
  if(tags MATCHES " campaign ")
    set(speed slow campaign)
  elseif(tags MATCHES " slow ")
    set(speed slow)
  elseif(tags MATCHES " needs ")
    set(speed quick)
  else()
    if(NOT file IN_LIST quick_files)
      list(APPEND quick_files ${file})
      get_filename_component(stem ${file} NAME)
      add(${file} "quick;${folders}" "[==[--filenames-as-tags]==] [==[[#${stem}]~[slow]~[needs]~[.]]==]")
    endif()
    continue()
  endif()
  string(REPLACE "<semicolon>" ";" name "${name}")
  string(REPLACE "<open>" "[" name "${name}")
  string(REPLACE "<close>" "]" name "${name}")
  string(REGEX REPLACE "([],[])" "\\\\\\1" pattern "${name}")  # commas and brackets are operators of Catch2
  add("${name}" "${speed};${folders}" "[==[${pattern}]==]")
endforeach()
file(WRITE ${SCRIPT} "${script}")
