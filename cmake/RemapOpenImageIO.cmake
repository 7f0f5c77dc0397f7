# OpenImageIO as the target OpenImageIO::OpenImageIO, for the runtime and for the compiler.
include_guard(DIRECTORY)  # imported targets are visible in the folder that finds them

# Debian's package of Imath reports libraries for Python that nobody asked for.
set(CMAKE_MESSAGE_LOG_LEVEL NOTICE)
find_package(OpenImageIO 2.4 REQUIRED)
unset(CMAKE_MESSAGE_LOG_LEVEL)

# Debian's package names the headers of OpenCV among its own, and nothing installs them: CMake refuses a
# target with a folder that is not there.
foreach(target OpenImageIO::OpenImageIO OpenImageIO::OpenImageIO_Util)
  get_target_property(folders ${target} INTERFACE_INCLUDE_DIRECTORIES)
  set(present "")
  foreach(folder IN LISTS folders)
    if(EXISTS "${folder}")
      list(APPEND present "${folder}")
    endif()
  endforeach()
  list(REMOVE_DUPLICATES present)
  set_target_properties(${target} PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${present}"
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${present}")
endforeach()
