# Runs fastddsgen once for all types. In: FASTDDSGEN SOURCE_DIR OUTPUT_DIR WORK_DIR, lists TYPES and MESSAGES (package/Type).
# Out: OUTPUT_DIR/<package>/msg/<Type>.{h,cxx}, for MESSAGES also <Type>PubSubTypes.{h,cxx}, and coop_idl/interface_version.hpp.
#
# fastddsgen generates the files that an IDL file includes again with each file on its command line, and takes three times
# as long that way as with one file that includes all. It writes into one flat folder, hence the check for equal names.
cmake_minimum_required(VERSION 3.25)
set(umbrella "")
set(definitions "")
set(names "")
foreach(type IN LISTS TYPES)
  string(REPLACE "/" "/msg/" stem "${type}")
  get_filename_component(name "${type}" NAME)
  if(name IN_LIST names)
    message(FATAL_ERROR "idl: two packages hold a type ${name}; the generator needs distinct names")
  endif()
  list(APPEND names "${name}")
  string(APPEND umbrella "#include \"${stem}.idl\"\n")
  file(READ "${SOURCE_DIR}/${stem}.idl" text)
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")
  string(REGEX REPLACE "[ \t\r\n]+" " " text "${text}")
  string(APPEND definitions "${stem} ${text}\n")
endforeach()

file(REMOVE_RECURSE "${WORK_DIR}")
file(MAKE_DIRECTORY "${WORK_DIR}/flat" "${WORK_DIR}/tmp")
file(WRITE "${WORK_DIR}/coop_idl_umbrella.idl" "${umbrella}")
execute_process(
  COMMAND "${FASTDDSGEN}" -replace -cs -typeros2 -t "${WORK_DIR}/tmp" -I "${SOURCE_DIR}" -d "${WORK_DIR}/flat"
          coop_idl_umbrella.idl
  WORKING_DIRECTORY "${WORK_DIR}"
  OUTPUT_VARIABLE log ERROR_VARIABLE log RESULT_VARIABLE result)
# The generator also exits 0 after some errors.
if(NOT result EQUAL 0 OR log MATCHES "ERROR|error:|Exception|Illegal")
  message(FATAL_ERROR "fastddsgen failed (${result}):\n${log}")
endif()

# Object addresses of the generator in comments would make every run a different text. And the generated topic support catches
# one exception only: a bool that is neither 0 nor 1, or an encapsulation other than plain CDR, sent by anybody on the network
# would end the process that receives it.
function(put name destination)
  if(NOT EXISTS "${WORK_DIR}/flat/${name}")
    message(FATAL_ERROR "fastddsgen did not write ${name}:\n${log}")
  endif()
  file(READ "${WORK_DIR}/flat/${name}" text)
  string(REGEX REPLACE " com\\.eprosima\\.[A-Za-z.]*@[0-9a-f]+" "" text "${text}")
  string(REPLACE "catch (eprosima::fastcdr::exception::NotEnoughMemoryException& /*exception*/)"
                 "catch (const std::exception&)" text "${text}")
  file(WRITE "${WORK_DIR}/clean" "${text}")
  file(COPY_FILE "${WORK_DIR}/clean" "${destination}/${name}" ONLY_IF_DIFFERENT)
endfunction()

foreach(type IN LISTS TYPES)
  string(REGEX REPLACE "/.*" "" package "${type}")
  get_filename_component(name "${type}" NAME)
  set(destination "${OUTPUT_DIR}/${package}/msg")
  file(MAKE_DIRECTORY "${destination}")
  put("${name}.h" "${destination}")
  put("${name}.cxx" "${destination}")
  if(type IN_LIST MESSAGES)
    put("${name}PubSubTypes.h" "${destination}")
    put("${name}PubSubTypes.cxx" "${destination}")
  endif()
endforeach()

# Equal definitions give equal versions on every machine; comments and white space do not count.
string(SHA256 digest "${definitions}")
string(SUBSTRING "${digest}" 0 8 version)
file(MAKE_DIRECTORY "${OUTPUT_DIR}/coop_idl")
file(WRITE "${WORK_DIR}/clean" "#pragma once
#include <cstdint>
namespace coop_idl {
// First 32 bits of the SHA-256 of all definitions in idl/. Two programs with different numbers must not be mixed.
inline constexpr std::uint32_t kInterfaceVersion = 0x${version}u;
}  // namespace coop_idl
")
file(COPY_FILE "${WORK_DIR}/clean" "${OUTPUT_DIR}/coop_idl/interface_version.hpp" ONLY_IF_DIFFERENT)
