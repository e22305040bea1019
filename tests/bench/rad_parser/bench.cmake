# Reading a million polygons, beside a plain strtod tokenizer and, where it is found, the original's own reader.
add_executable(bench_parser ${CMAKE_CURRENT_LIST_DIR}/parser.cpp)
target_link_libraries(bench_parser PRIVATE rad_parser benchmark::benchmark)
