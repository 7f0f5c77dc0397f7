# Tests a project with remap as a subfolder. The same commands must configure it. remap must not add installation
# rules or tests to it. Its includes must find remap's headers in the same way. Building remapc again would take
# minutes, so the test reads the build files instead.
source "$(dirname "$0")/check.bash"
compiler=$3
id=mitsuba_ward_to_mitsuba_as

cat >"$work/CMakeLists.txt" <<CMAKE
cmake_minimum_required(VERSION 3.22)
project(game LANGUAGES CXX)
add_subdirectory("$source_folder" remap EXCLUDE_FROM_ALL)
add_executable(shipped main.cpp)
target_link_libraries(shipped PRIVATE remap::headers)
add_executable(own_fit main.cpp)
add_library(also_own_fit STATIC main.cpp)
foreach(target own_fit also_own_fit)
  remap_add_converter(\${target} fits/$id.json)
endforeach()
CMAKE
cp "$source_folder/examples/outside_project/main.cpp" "$work"
mkdir "$work/fits"
cp "$source_folder/fits/$id.json" "$work/fits"

expect_exit 0 cmake -S "$work" -B "$work/build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler"
expect_exit 0 cmake --build "$work/build" --target shipped
expect_exit 0 "$work/build/shipped"

# The plan to build own_fit must have remapc first, then the emission, then the program.
expect_exit 0 ninja -C "$work/build" -n -v own_fit also_own_fit
line_of() { grep -nE -m 1 -- "$1" "$work/output" | cut -d : -f 1; }
linked=$(line_of '-o remap/bin/remapc') emitted=$(line_of "remapc emit .*fits/$id.json") compiled=$(line_of 'own_fit.dir/main.cpp.o -c')
[[ -n $linked && -n $emitted && -n $compiled ]] || fail "the plan lacks a step: $linked, $emitted, $compiled"
((linked < emitted && emitted < compiled)) || fail "the plan is out of order: $linked, $emitted, $compiled"
[[ $(grep -cE "remapc emit .*fits/$id.json" "$work/output") == 1 ]] || fail "one fit is emitted twice"
