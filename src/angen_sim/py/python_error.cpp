#include <algorithm>

#include "py/bindings.h"

namespace angen::py {

namespace pyb = pybind11;

namespace {

std::string text_of(const pyb::handle& value) { return pyb::cast<std::string>(pyb::str(value)); }

bool is_of_python(const std::string& file) {
  return file.empty() || file.front() == '<' || file.rfind("/usr/lib/", 0) == 0;
}

}  // namespace

std::string one_line(const pyb::error_already_set& error) {
  std::string place, text;
  if (error.matches(PyExc_SyntaxError)) {
    place = text_of(error.value().attr("filename")) + ":" + text_of(error.value().attr("lineno"));
    text = text_of(error.value().attr("msg"));
  } else {
    for (pyb::object at = error.trace(); at && !at.is_none(); at = at.attr("tb_next")) {
      const std::string file = text_of(at.attr("tb_frame").attr("f_code").attr("co_filename"));
      if (!is_of_python(file)) place = file + ":" + text_of(at.attr("tb_lineno"));
    }
    text = text_of(error.value());
  }
  std::replace(text.begin(), text.end(), '\n', ' ');
  return (place.empty() ? "" : place + ": ") + text_of(error.type().attr("__name__")) +
         (text.empty() ? "" : ": " + text);
}

}  // namespace angen::py
