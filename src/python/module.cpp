#include "python/bindings.hpp"

PYBIND11_MODULE(_edda, m) {
  m.doc() = "The compiled part of edda.";
  edda::python::add_records(m);  // returned by functions of models
  edda::python::add_models(m);
  edda::python::add_simulation(m);
  edda::python::add_studies(m);
}
