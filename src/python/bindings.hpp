// The Python module edda._edda: library/edda.hpp and library/study.hpp as seen from Python. Shapes
// and units are given in edda/_edda.pyi.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <span>
#include <string>
#include <vector>

#include "library/edda.hpp"

namespace edda::python {

namespace py = pybind11;

void add_models(py::module_& module);
void add_records(py::module_& module);
void add_simulation(py::module_& module);
void add_studies(py::module_& module);

/// A view without a copy of memory that `owner` keeps alive.
template <class T>
py::array view_of(std::span<T> values, const py::object& owner) {
  using Value = std::remove_const_t<T>;
  py::array_t<Value> array(static_cast<py::ssize_t>(values.size()), values.data(), owner);
  if constexpr (std::is_const_v<T>) array.attr("flags").attr("writeable") = false;
  return array;
}

/// Points as an array (n, 2).
py::array_t<double> array_of(const std::vector<api::Point>& points);

}  // namespace edda::python
