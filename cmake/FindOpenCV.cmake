# Debian's OpenCVConfig.cmake comes with libopencv-dev and demands every module of OpenCV (356 packages on a clean system).
# Coop uses a few, whose development packages it asks for one by one (137 packages): this module finds those, with the
# target names OpenCV itself uses (opencv_core, opencv_imgproc, opencv_imgcodecs).
include(FindPackageHandleStandardArgs)
find_path(OpenCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
foreach(component IN LISTS OpenCV_FIND_COMPONENTS)
  find_library(OpenCV_${component}_LIBRARY opencv_${component})
  if(OpenCV_INCLUDE_DIR AND OpenCV_${component}_LIBRARY)
    set(OpenCV_${component}_FOUND TRUE)
  endif()
endforeach()
find_package_handle_standard_args(OpenCV REQUIRED_VARS OpenCV_INCLUDE_DIR HANDLE_COMPONENTS)

if(OpenCV_FOUND)
  set(OpenCV_LIBS "")
  foreach(component IN LISTS OpenCV_FIND_COMPONENTS)
    if(NOT TARGET opencv_${component})
      add_library(opencv_${component} UNKNOWN IMPORTED GLOBAL)
      set_target_properties(opencv_${component} PROPERTIES
        IMPORTED_LOCATION "${OpenCV_${component}_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${OpenCV_INCLUDE_DIR}")
      if(NOT component STREQUAL "core" AND TARGET opencv_core)
        set_property(TARGET opencv_${component} PROPERTY INTERFACE_LINK_LIBRARIES opencv_core)
      endif()
    endif()
    list(APPEND OpenCV_LIBS opencv_${component})
  endforeach()
endif()
mark_as_advanced(OpenCV_INCLUDE_DIR)
