cmake_minimum_required(VERSION 3.16)
# roslaunch refuses a launch file whose name it finds twice in the package's folder, where a build and what its tests
# install may lie as well. cmake -DPACKAGE_DIRECTORY=<folder> -P check_launch_files.cmake
file(GLOB_RECURSE found RELATIVE ${PACKAGE_DIRECTORY} ${PACKAGE_DIRECTORY}/*.launch)
list(FILTER found EXCLUDE REGEX "(^|/)[.]")  # roslaunch does not look into hidden folders
set(names)
foreach(file IN LISTS found)
  get_filename_component(name ${file} NAME)
  if(name IN_LIST names)
    message(FATAL_ERROR "more than one ${name}: ${found}")
  endif()
  list(APPEND names ${name})
endforeach()
if(NOT "insertion.launch" IN_LIST names)
  message(FATAL_ERROR "no insertion.launch in ${PACKAGE_DIRECTORY}: ${found}")
endif()
