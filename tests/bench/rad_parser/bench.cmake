# Reads a million polygons, and compares with a plain strtod tokenizer and, if it is installed, RADIANCE's own reader.
add_executable(bench_parser ${CMAKE_CURRENT_LIST_DIR}/parser.cpp)
target_link_libraries(bench_parser PRIVATE rad_parser benchmark::benchmark)
