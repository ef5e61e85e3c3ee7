# cmake -D staged=FOLDER -P cli/docs/stage_headers.cmake: the headers that users get, as they are installed.
set(source ${CMAKE_CURRENT_LIST_DIR}/../../thermal_core)
include(${source}/package/public_headers.cmake)
include(${source}/package/stage_headers.cmake)
