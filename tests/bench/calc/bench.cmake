# The time to evaluate function files at a point, for the kinds of functions that scenes use.
add_executable(bench_calc ${CMAKE_CURRENT_LIST_DIR}/evaluate.cpp)
target_link_libraries(bench_calc PRIVATE rad_parser benchmark::benchmark)
