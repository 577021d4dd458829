#include <cstdlib>
#include <cstring>
#include <regex>
#include <string>

#include "py/bindings.h"

namespace angen::py {

namespace {

namespace pyb = pybind11;

// "run(self, seconds, long_steps= False)" of "run(self: angen.World, seconds: float, …)".
std::string without_types(const std::string& signature) {
  std::string kept;
  int depth = 0;
  bool in_type = false;
  for (const char each : signature) {
    depth +=
        static_cast<int>(each == '(' || each == '[') - static_cast<int>(each == ')' || each == ']');
    if (depth == 1 && each == ':') in_type = true;
    if (depth == 0 || (depth == 1 && (each == ',' || each == '='))) in_type = false;
    if (!in_type) kept += each;
  }
  return kept;
}

// pybind11 begins a doc with "NAME(PARAMETERS) -> TYPE". CPython reads parameters from a doc that
// begins with "NAME(PARAMETERS)\n--\n\n", without types, and shows the rest as the doc. Their
// defaults are literals, and infinity has none but a number that is too large.
std::string signed_doc(const std::string& doc) {
  const std::size_t arrow = doc.rfind(" -> ", doc.find('\n'));
  if (arrow == std::string::npos) return doc;
  static const std::regex infinity("= (-?)inf\\b");
  return std::regex_replace(without_types(doc.substr(0, arrow)), infinity, "= $011e999") +
         "\n--\n\n" + doc;
}

void sign_function(PyObject* function) {
  PyMethodDef* method = reinterpret_cast<PyCFunctionObject*>(function)->m_ml;
  if (method->ml_doc == nullptr || std::strstr(method->ml_doc, "\n--\n\n") != nullptr) return;
  const std::string doc = signed_doc(method->ml_doc);
  std::free(
      const_cast<char*>(method->ml_doc));  // NOLINT: pybind11 has it of strdup(), and frees it
  method->ml_doc = strdup(doc.c_str());
}

void sign_all(const pyb::object& scope, const std::string& module) {
  const pyb::dict entries(scope.attr("__dict__"));
  for (const auto& [name, value] : entries) {
    const bool is_static = pyb::isinstance<pyb::staticmethod>(value);
    const pyb::object held = is_static ? value.attr("__func__") : pyb::cast<pyb::object>(value);
    PyObject* object = held.ptr();
    if (PyInstanceMethod_Check(object)) object = PyInstanceMethod_Function(object);
    if (PyCFunction_Check(object)) {
      sign_function(object);
    } else if (PyType_Check(object) && pyb::str(value.attr("__module__")).equal(pyb::str(module))) {
      sign_all(held, module);
    }
  }
}

}  // namespace

void sign(const pyb::module_& module) {
  sign_all(module, pyb::cast<std::string>(module.attr("__name__")));
}

}  // namespace angen::py
