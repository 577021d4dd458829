#include <Python.h>

#include <string>

namespace {

// The message of the present exception, in one line.
std::string problem_of_python() {
  PyObject *type = nullptr, *value = nullptr, *trace = nullptr;
  PyErr_Fetch(&type, &value, &trace);
  PyObject* text = value == nullptr ? nullptr : PyObject_Str(value);
  const char* utf8 = text == nullptr ? nullptr : PyUnicode_AsUTF8(text);
  std::string problem = utf8 == nullptr ? "no reason given" : utf8;
  for (PyObject* each : {type, value, trace, text}) Py_XDECREF(each);
  PyErr_Clear();
  return problem.substr(0, problem.find('\n'));
}

}  // namespace

/// Starts the interpreter, which runs until the process ends, and imports `angen`, whose import
/// says how scripts are loaded. Signals stay the program's. `problem` is the error.
extern "C" void angen_start_python(std::string& problem) {
  PyConfig config;
  PyConfig_InitPythonConfig(&config);
  config.install_signal_handlers = 0;
  config.write_bytecode = 0;
  PyStatus status = PyConfig_SetBytesString(&config, &config.executable, ANGEN_PYTHON);
  if (PyStatus_Exception(status) == 0) status = Py_InitializeFromConfig(&config);
  PyConfig_Clear(&config);
  if (PyStatus_Exception(status) != 0) {
    problem = status.err_msg == nullptr ? "no reason given" : status.err_msg;
    return;
  }
  PyObject* module = PyImport_ImportModule("angen");
  if (module == nullptr) problem = problem_of_python();
  PyEval_SaveThread();  // releases the lock that the start took
}
