# Rays through rsphere and through the rtrace of the machine, in turn.
add_executable(bench_rtrace ${CMAKE_CURRENT_LIST_DIR}/bench_rtrace.cpp)
target_link_libraries(bench_rtrace PRIVATE fmt::fmt)
target_compile_definitions(bench_rtrace PRIVATE RSPHERE_SCENES="${CMAKE_CURRENT_LIST_DIR}/scenes"
                           RSPHERE_REFERENCES="${CMAKE_CURRENT_LIST_DIR}/references"
                           RSPHERE_EXAMPLES="${PROJECT_SOURCE_DIR}/examples")
add_dependencies(bench_rtrace rsphere)
