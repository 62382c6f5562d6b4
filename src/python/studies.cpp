// Samples of a study.
#include "library/study.hpp"
#include "python/bindings.hpp"

namespace edda::python {

void add_studies(py::module_& module) {
  module.def(
      "study_sample",
      [](const std::string& study, const std::string& model, const std::vector<double>& point,
         const std::string& scratch) {
        const py::gil_scoped_release release;
        const api::StudyAnswer answer = api::study_sample(study, model, point, scratch);
        return std::pair(answer.cells, answer.message);
      },
      py::arg("study"), py::arg("model"), py::arg("point"), py::arg("scratch"),
      "The answers of one sample as study.csv has them, and why there is none.");
  py::class_<api::StudyWorker>(module, "StudyWorker", "A worker in the folder of a study.")
      .def(py::init<const std::string&>(), py::arg("folder"), "In a folder that edda study leads.")
      .def_property_readonly("study", &api::StudyWorker::study, "Text of study.toml.")
      .def_property_readonly("model", &api::StudyWorker::model, "Text of the model.")
      .def(
          "take",
          [](api::StudyWorker& worker)
              -> std::optional<std::pair<std::size_t, std::vector<double>>> {
            const auto sample = worker.take();
            if (!sample) return std::nullopt;
            return std::pair(sample->number, sample->point);
          },
          "The next sample and its values; None where none is free now.")
      .def(
          "finish",
          [](api::StudyWorker& worker, std::size_t number, std::vector<std::string> cells,
             std::string message) {
            worker.finish(number, {std::move(cells), std::move(message)});
          },
          py::arg("number"), py::arg("cells"), py::arg("message"), "Writes a sample's answers.");
}

}  // namespace edda::python
