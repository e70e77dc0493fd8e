# OpenEXRCore, the C library of OpenEXR, and libdeflate as part of our own binary: static, hidden, pure C.
# Offers the target dp_openexr. Nothing of the system's but its C library goes in.
#
# The sources are those of the Python packages `openexr` and `deflate` (their source archives hold the
# whole trees), fetched once into a cache folder and checked.
#   -DDP_OPENEXR_ARCHIVE=/path/openexr-3.3.14.tar.gz   an archive that is already here
#   -DDP_DEFLATE_ARCHIVE=/path/deflate-0.9.0.tar.gz
#   -DDP_CACHE=/path                                   where fetched archives are kept
set(DP_OPENEXR_VERSION 3.3.14)
set(DP_OPENEXR_SHA256 de0c6a441fca71c869b3f00b55d1a33f5cf93ee49cb2a77fa0006dc06934f50a)
set(DP_OPENEXR_ARCHIVE "" CACHE FILEPATH "The archive of OpenEXR, if it is here already")
set(DP_DEFLATE_VERSION 0.9.0)  # holds libdeflate 1.26
set(DP_DEFLATE_SHA256 962e0a6f1ea3a94b900a8ea0ce138fa92bfcbafda5b86367104a259ffcd3462b)
set(DP_DEFLATE_ARCHIVE "" CACHE FILEPATH "The archive of deflate, if it is here already")

if(DEFINED ENV{XDG_CACHE_HOME})
  set(dp_cache_default "$ENV{XDG_CACHE_HOME}/desire_path")
elseif(DEFINED ENV{HOME})
  set(dp_cache_default "$ENV{HOME}/.cache/desire_path")
else()
  set(dp_cache_default "${CMAKE_BINARY_DIR}/cache")
endif()
set(DP_CACHE "${dp_cache_default}" CACHE PATH "Where fetched archives are kept")

# Put the path of the checked archive of a package into `result`, fetching it when it is not here. One
# configure run at a time does so; it appears under its name only when whole.
function(dp_fetch package result)
  string(TOUPPER ${package} word)
  set(name ${package}-${DP_${word}_VERSION}.tar.gz)
  if(DP_${word}_ARCHIVE)
    set(archive ${DP_${word}_ARCHIVE})
  else()
    set(archive ${DP_CACHE}/${name})
    file(MAKE_DIRECTORY ${DP_CACHE})
    file(LOCK ${DP_CACHE}/${package}.lock GUARD FUNCTION TIMEOUT 600)
    if(NOT EXISTS ${archive})
      find_package(Python3 COMPONENTS Interpreter QUIET)
      set(part ${DP_CACHE}/${package}.part)
      message(STATUS "Fetching ${package} ${DP_${word}_VERSION} into ${DP_CACHE}")
      set(fetched 1)
      foreach(pip "${Python3_EXECUTABLE};-m;pip" "python3;-m;pip" "pip3" "pip")
        if(NOT fetched EQUAL 0)
          file(REMOVE_RECURSE ${part})
          execute_process(
            COMMAND ${pip} download --quiet --disable-pip-version-check --no-deps
                    --no-binary ${package} --dest ${part} ${package}==${DP_${word}_VERSION}
            RESULT_VARIABLE fetched OUTPUT_VARIABLE words ERROR_VARIABLE words)
        endif()
      endforeach()
      if(NOT fetched EQUAL 0 OR NOT EXISTS ${part}/${name})
        message(FATAL_ERROR "${package} could not be fetched with pip. Give the archive by "
                            "-DDP_${word}_ARCHIVE=.../${name}.\n${words}")
      endif()
      file(RENAME ${part}/${name} ${archive})
      file(REMOVE_RECURSE ${part})
    endif()
  endif()
  file(SHA256 ${archive} seen)
  if(NOT seen STREQUAL DP_${word}_SHA256)
    message(FATAL_ERROR "${archive} is not the archive that was expected: delete it and try again")
  endif()
  set(${result} ${archive} PARENT_SCOPE)
endfunction()

set(dp_openexr_tree ${CMAKE_BINARY_DIR}/openexr-${DP_OPENEXR_VERSION})
if(NOT EXISTS ${dp_openexr_tree}/whole)
  dp_fetch(openexr dp_archive)
  file(ARCHIVE_EXTRACT INPUT ${dp_archive} DESTINATION ${CMAKE_BINARY_DIR}
       PATTERNS "*/src/lib/OpenEXRCore/*" "*/cmake/*.in" "*/LICENSE.md")
  file(TOUCH ${dp_openexr_tree}/whole)
endif()
set(dp_deflate_tree ${CMAKE_BINARY_DIR}/deflate-${DP_DEFLATE_VERSION})
if(NOT EXISTS ${dp_deflate_tree}/whole)
  dp_fetch(deflate dp_archive)
  file(ARCHIVE_EXTRACT INPUT ${dp_archive} DESTINATION ${CMAKE_BINARY_DIR} PATTERNS "*/libdeflate/*")
  file(TOUCH ${dp_deflate_tree}/whole)
endif()
set(dp_deflate_tree ${dp_deflate_tree}/libdeflate)

# the headers that OpenEXR's own configuration would write, as it would on Linux; of them
# the C library reads the version and whether there are threads. Without Imath's half.h it has its own half.
string(REPLACE "." ";" dp_openexr_numbers ${DP_OPENEXR_VERSION})
list(GET dp_openexr_numbers 0 OPENEXR_VERSION_MAJOR)
list(GET dp_openexr_numbers 1 OPENEXR_VERSION_MINOR)
list(GET dp_openexr_numbers 2 OPENEXR_VERSION_PATCH)
set(OPENEXR_VERSION ${DP_OPENEXR_VERSION})
set(OPENEXR_PACKAGE_NAME "OpenEXR ${DP_OPENEXR_VERSION}")
set(OPENEXR_NAMESPACE_CUSTOM 0)
set(OPENEXR_IMF_NAMESPACE Imf)
set(OPENEXR_INTERNAL_IMF_NAMESPACE Imf_desire_path)
set(OPENEXR_HAVE_LARGE_STACK ON)
set(OPENEXR_IMF_HAVE_LINUX_PROCFS ON)
set(OPENEXR_IMF_HAVE_SYSCONF_NPROCESSORS_ONLN ON)
set(ILMTHREAD_THREADING_ENABLED ON)
set(ILMTHREAD_HAVE_POSIX_SEMAPHORES ON)
set(ILMTHREAD_NAMESPACE_CUSTOM 0)
set(ILMTHREAD_NAMESPACE IlmThread)
set(ILMTHREAD_INTERNAL_NAMESPACE IlmThread_desire_path)
foreach(header OpenEXRConfig OpenEXRConfigInternal IlmThreadConfig)
  configure_file(${dp_openexr_tree}/cmake/${header}.h.in ${CMAKE_BINARY_DIR}/openexr/${header}.h)
endforeach()
file(CONFIGURE OUTPUT openexr/ImathConfig.h CONTENT "// Imath is not used: OpenEXRCore has a half of its own\n")

file(GLOB dp_openexr_sources ${dp_openexr_tree}/src/lib/OpenEXRCore/*.c)
add_library(OpenEXRCore STATIC EXCLUDE_FROM_ALL ${dp_openexr_sources})
target_include_directories(OpenEXRCore SYSTEM PUBLIC ${dp_openexr_tree}/src/lib/OpenEXRCore
  ${CMAKE_BINARY_DIR}/openexr ${dp_deflate_tree})
target_compile_options(OpenEXRCore PRIVATE -w)
set_target_properties(OpenEXRCore PROPERTIES C_EXTENSIONS ON)
if(DP_SANITIZE)  # damaged files must not get past its borders either
  target_compile_options(OpenEXRCore PRIVATE -fsanitize=address -g -O1)
endif()

file(GLOB dp_deflate_sources ${dp_deflate_tree}/lib/*.c ${dp_deflate_tree}/lib/arm/*.c
  ${dp_deflate_tree}/lib/x86/*.c)
add_library(deflate STATIC EXCLUDE_FROM_ALL ${dp_deflate_sources})
target_include_directories(deflate SYSTEM PRIVATE ${dp_deflate_tree})
target_compile_options(deflate PRIVATE -w)
set_target_properties(deflate PROPERTIES C_EXTENSIONS ON)
if(APPLE)  # it asks for its names to be shown, and no list tells this linker what a module shows
  target_compile_options(deflate PRIVATE -fvisibility=hidden "-Dvisibility(kind)=unused")
endif()
if(DP_PLATFORM)  # it takes this Clang for one that needs no word for registers of 512 bits
  target_compile_definitions(deflate PRIVATE LIBDEFLATE_ASSEMBLER_DOES_NOT_SUPPORT_AVX512VNNI
    LIBDEFLATE_ASSEMBLER_DOES_NOT_SUPPORT_VPCLMULQDQ)
endif()

add_library(dp_openexr INTERFACE)
target_link_libraries(dp_openexr INTERFACE OpenEXRCore deflate ${DP_SYSTEM_LIBRARIES})
