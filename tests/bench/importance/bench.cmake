# Ours against equal weights in the same time, over rotations of the directions.
add_executable(bench_importance ${CMAKE_CURRENT_LIST_DIR}/equal_time.cpp)
target_link_libraries(bench_importance PRIVATE rsphere_cli)
target_compile_definitions(bench_importance PRIVATE RSPHERE_SCENES="${CMAKE_CURRENT_LIST_DIR}/scenes"
                           RSPHERE_OPENPLAN="${PROJECT_SOURCE_DIR}/examples/openplan/generate")

# What stopping by estimated errors (-Sa) makes of the mean.
add_executable(bench_stopping ${CMAKE_CURRENT_LIST_DIR}/stopping.cpp)
target_link_libraries(bench_stopping PRIVATE rsphere_cli)

# Which paths make the tails.
add_executable(bench_heavy_paths ${CMAKE_CURRENT_LIST_DIR}/heavy_paths.cpp)
target_link_libraries(bench_heavy_paths PRIVATE rsphere_cli)
