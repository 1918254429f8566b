// The extension module keyline._keyline: operations as they are declared, and curves and surfaces
// that answer for whole NumPy arrays. The package around it makes them pleasant.

#include <condition_variable>
#include <mutex>
#include <thread>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <nlohmann/json.hpp>

#include "keyline/core/version.h"
#include "keyline/operations/held_curve.h"
#include "keyline/operations/operation.h"
#include "keyline/operations/perform.h"
#include "keyline/operations/schema.h"

#include "objects.h"

namespace py = pybind11;

namespace keyline::python {
namespace {

using core::Result;
using nlohmann::json;
using operations::Along;
using operations::HeldCurve;
using operations::HeldSurface;
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

py::list declared() {
  py::list all;
  for (const operations::Operation& operation : operations::operations()) {
    py::dict one;
    one["name"] = operation.name;
    one["summary"] = operation.summary;
    one["long_running"] = operation.long_running;
    py::list order;
    core::visit_fields(*operation.request, operation.request->make().get(),
                       [&](const core::Field& field, const void*) {
                         order.append(py::str(std::string(field.name)));
                       });
    one["order"] = order;
    one["request"] = to_python(operations::request_schema(operation));
    one["result"] = to_python(operations::result_schema(operation));
    all.append(one);
  }
  return all;
}

/// Work on a thread of its own, told about by the thread that asked: Python's signals and the
/// caller's function are only ever served there.
class LongCall {
 public:
  Result<json> run(const std::string& name, const json& request, int threads,
                   const py::object& progress) {
    operations::Context context{threads, {}};
    context.progress.sink = [this](double fraction, std::string_view doing) {
      const std::scoped_lock lock(mutex_);
      fraction_ = fraction;
      doing_ = doing;
    };
    context.progress.cancellation = token_;
    std::thread worker([&] {
      Result<json> result = operations::perform(name, request, context);
      const std::scoped_lock lock(mutex_);
      result_ = std::move(result);
      finished_.notify_one();
    });
    try {
      while (!wait()) tell(progress);
      if (!progress.is_none()) tell(progress);
    } catch (...) {
      token_.request_stop();
      {
        const py::gil_scoped_release release;
        worker.join();
      }
      throw;
    }
    worker.join();
    return std::move(*result_);
  }

 private:
  /// A twentieth of a second: what a hand on Ctrl-C does not notice.
  static constexpr std::chrono::milliseconds kBeat{50};

  bool wait() {
    const py::gil_scoped_release release;
    std::unique_lock lock(mutex_);
    return finished_.wait_for(lock, kBeat, [this] { return result_.has_value(); });
  }

  void tell(const py::object& progress) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (progress.is_none()) return;
    double fraction = 0;
    std::string doing;
    {
      const std::scoped_lock lock(mutex_);
      fraction = fraction_;
      doing = doing_;
    }
    progress(fraction, doing);
  }

  core::CancellationToken token_ = core::CancellationToken::make();
  std::mutex mutex_;
  std::condition_variable finished_;
  double fraction_ = 0;
  std::string doing_;
  std::optional<Result<json>> result_;
};

py::object perform(const std::string& name, const py::dict& fields, int threads,
                   const py::object& progress) {
  const json request = to_json(fields, "");
  const operations::Operation* operation = operations::find_operation(name);
  Result<json> result;
  if (operation && operation->long_running) {
    result = LongCall().run(name, request, threads, progress);
  } else {
    const py::gil_scoped_release release;
    result = operations::perform(name, request, {threads, {}});
  }
  if (!result) raise(result.error());
  return to_python(*result);
}

/// One answer per place, in an array of the places' shape with the answer's width added.
py::array_t<double> ask(const HeldCurve& curve, Along what, const Doubles& at) {
  const std::size_t width = curve.width(what);
  std::vector<py::ssize_t> shape(at.shape(), at.shape() + at.ndim());
  if (width > 1) shape.push_back(static_cast<py::ssize_t>(width));
  py::array_t<double> out(shape);
  const std::span<const double> places(at.data(), static_cast<std::size_t>(at.size()));
  const std::span<double> answers(out.mutable_data(), static_cast<std::size_t>(out.size()));
  Result<void> done;
  {
    const py::gil_scoped_release release;
    done = curve.ask(what, places, answers);
  }
  if (!done) raise(done.error());
  return out;
}

using SurfaceQuestion = Result<void> (HeldSurface::*)(std::span<const double>,
                                                      std::span<const double>,
                                                      std::span<double>) const;

py::array_t<double> ask_surface(const HeldSurface& surface, SurfaceQuestion question,
                                const Doubles& u, const Doubles& v) {
  if (u.size() != v.size()) throw py::value_error("u and v differ in size");
  std::vector<py::ssize_t> shape(u.shape(), u.shape() + u.ndim());
  shape.push_back(3);
  py::array_t<double> out(shape);
  const auto size = static_cast<std::size_t>(u.size());
  const std::span<double> answers(out.mutable_data(), 3 * size);
  Result<void> done;
  {
    const py::gil_scoped_release release;
    done = (surface.*question)({u.data(), size}, {v.data(), size}, answers);
  }
  if (!done) raise(done.error());
  return out;
}

/// The column as an array that keeps it: nothing is copied.
template <class T>
py::array column(std::vector<T> values, py::ssize_t width, const char* type) {
  const auto rows = static_cast<py::ssize_t>(values.size()) / width;
  auto* kept = new std::vector<T>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<T>*>(p); });
  const std::vector<py::ssize_t> shape =
      width > 1 ? std::vector<py::ssize_t>{rows, width} : std::vector<py::ssize_t>{rows};
  return py::array(py::dtype(type), shape, kept->data(), owner);
}

py::dict segments(const Doubles& points, const Doubles& alpha, int threads) {
  if (points.ndim() != 3 || points.shape(1) != 3 || points.shape(2) != 2)
    throw py::value_error("points: an array of shape (n, 3, 2) is wanted");
  const std::span<const double> handles(points.data(), static_cast<std::size_t>(points.size()));
  const std::span<const double> slopes(alpha.data(), static_cast<std::size_t>(alpha.size()));
  Result<operations::SegmentColumns> solved;
  {
    const py::gil_scoped_release release;
    solved = operations::many_segments(handles, slopes, threads);
  }
  if (!solved) raise(solved.error());
  py::dict columns;
  columns["start"] = column(std::move(solved->start), 2, "f8");
  columns["direction"] = column(std::move(solved->direction), 1, "f8");
  columns["length"] = column(std::move(solved->length), 1, "f8");
  columns["curvature"] = column(std::move(solved->curvature), 2, "f8");
  columns["lambda_"] = column(std::move(solved->lambda), 1, "f8");
  columns["drawn"] = column(std::move(solved->drawn), 1, "?");
  columns["reversed"] = column(std::move(solved->reversed), 1, "?");
  return columns;
}

template <class Held>
Held held_of(const py::object& value) {
  auto held = Held::from_json(to_json(value, ""));
  if (!held) raise(held.error());
  return std::move(*held);
}

void define_curve(py::module_& module) {
  py::class_<HeldCurve> curve(module, "HeldCurve");
  curve.def(py::init([](const py::object& value) { return held_of<HeldCurve>(value); }))
      .def("value", [](const HeldCurve& self) { return to_python(self.to_json()); })
      .def_property_readonly("length", &HeldCurve::length)
      .def_property_readonly("dimension", &HeldCurve::dimension);
  curve.def("bezier", [](const HeldCurve& self, double tolerance, int degree) {
    Result<json> made;
    {
      const py::gil_scoped_release release;
      made = self.bezier(tolerance, degree);
    }
    if (!made) raise(made.error());
    return to_python(*made);
  });
  for (const auto& [name, what] :
       {std::pair{"point", Along::point}, std::pair{"tangent", Along::tangent},
        std::pair{"curvature", Along::curvature},
        std::pair{"curvature_rate", Along::curvature_rate}, std::pair{"torsion", Along::torsion},
        std::pair{"tangent_angle", Along::tangent_angle}})
    curve.def(name, [what = what](const HeldCurve& self, const Doubles& at) {
      return ask(self, what, at);
    });
}

}  // namespace
}  // namespace keyline::python

PYBIND11_MODULE(_keyline, module) {
  using namespace keyline::python;
  module.attr("__version__") = keyline::core::version();
  module.def("declared", &declared, "Every operation: name, summary and schemas.");
  module.def("perform", &perform, py::arg("name"), py::arg("fields"), py::arg("threads"),
             py::arg("progress"));
  module.def("segments", &segments, py::arg("points"), py::arg("alpha"), py::arg("threads"));
  define_curve(module);
  py::class_<keyline::operations::HeldSurface>(module, "HeldSurface")
      .def(py::init(
          [](const py::object& value) { return held_of<keyline::operations::HeldSurface>(value); }))
      .def("value",
           [](const keyline::operations::HeldSurface& self) { return to_python(self.to_json()); })
      .def("point", [](const keyline::operations::HeldSurface& self, const Doubles& u,
                       const Doubles& v) { return ask_surface(self, &HeldSurface::points, u, v); })
      .def("normal",
           [](const keyline::operations::HeldSurface& self, const Doubles& u, const Doubles& v) {
             return ask_surface(self, &HeldSurface::normals, u, v);
           });
}
