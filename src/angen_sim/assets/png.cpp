#include "assets/png.h"

#include "assets/converter.h"
#include "document/xml.h"

namespace angen::load {

GrayImage read_png(const std::string& path, const std::string& what, unsigned least,
                   const Source& at) {
  const std::string bytes = read_file(path);
  try {
    return decode_gray(convert_gray(mesh_program(), bytes, least));
  } catch (const Error& problem) {
    throw Error(at, what + " " + path + " " + problem.what());
  }
}

}  // namespace angen::load
