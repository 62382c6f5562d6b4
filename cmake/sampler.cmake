# edda-sampler: the sampling and reliability methods of `edda study`, a program of its own beside edda (src/sampler/main.cpp
# says why). Without OpenTURNS it is left out; `edda study` then says so.
find_package(OpenTURNS CONFIG QUIET)
find_package(Ceres CONFIG QUIET)
if(OpenTURNS_FOUND AND Ceres_FOUND)
  file(GLOB sampler_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/sampler/*.cpp)
  add_executable(edda-sampler ${sampler_sources})
  target_link_libraries(edda-sampler PRIVATE edda_flags nlohmann_json::nlohmann_json ${OPENTURNS_LIBRARY} Ceres::ceres Eigen3::Eigen)
  target_include_directories(edda-sampler SYSTEM PRIVATE ${OPENTURNS_INCLUDE_DIRS})
  add_dependencies(edda edda-sampler)  # who builds edda has both
  install(TARGETS edda-sampler RUNTIME DESTINATION lib/edda)
else()
  message(STATUS "OpenTURNS (libopenturns-dev) or Ceres (libceres-dev) is missing: edda study cannot draw samples")
endif()
