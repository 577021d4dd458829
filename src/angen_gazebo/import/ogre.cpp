#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "core/files.h"
#include "core/text.h"
#include "document/search.h"
#include "document/xml.h"
#include "import/gazebo.h"

namespace angen::load {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxWords = 5;  // words of a statement that are read: diffuse r g b a

// Calls `use` with each word of a line; braces stand for themselves, and a comment ends it.
template <class F>
void each_word(std::string_view line, const F& use) {
  std::string word;
  const auto end_word = [&] {
    if (!word.empty()) use(std::exchange(word, {}));
  };
  bool quoted = false;
  for (const char c : line.substr(0, line.find("//"))) {
    if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && (c == '{' || c == '}')) {
      end_word();
      use(std::string(1, c));
    } else if (!quoted && (c == ' ' || c == '\t' || c == '\r')) {
      end_word();
    } else {
      word += c;
    }
  }
  end_word();
}

std::optional<Eigen::Vector4f> color_in(const std::vector<std::string>& words) {
  Eigen::Vector4f color(0.0F, 0.0F, 0.0F, 1.0F);
  if (words.size() < 4) return std::nullopt;
  for (std::size_t i = 0; i < std::min<std::size_t>(words.size() - 1, 4); ++i) {
    const std::optional<double> value = parse_finite(words[i + 1]);
    if (!value) return std::nullopt;
    color[static_cast<Eigen::Index>(i)] = static_cast<float>(std::clamp(*value, 0.0, 1.0));
  }
  return color;
}

std::vector<std::string> scripts_at(const std::string& path) {
  std::vector<std::string> files;
  std::error_code failed;
  const auto add = [&](const fs::path& file) {
    if (is_plain_file(file.string())) files.push_back(file.string());
  };
  if (!fs::is_directory(path, failed)) {
    add(path);
    return files;
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(path, failed)) {
    if (entry.path().extension() == ".material") add(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// The material called `name` in a script's text, with the name of its picture.
std::optional<OgreMaterial> material_in(const std::string& text, const std::string& name) {
  std::optional<OgreMaterial> found;
  int depth = 0;
  const auto read = [&](const std::vector<std::string>& words) {
    if (words.size() < 2) return;
    if (depth == 0 && !found && words[0] == "material" && words[1] == name) found.emplace();
    if (depth == 0 || !found) return;
    if (words[0] == "diffuse" && !found->diffuse) found->diffuse = color_in(words);
    if (words[0] == "texture" && found->texture.empty()) found->texture = words[1];
  };
  bool complete = false;
  for (std::size_t begin = 0; begin < text.size() && !complete;) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::vector<std::string> statement;
    each_word(std::string_view(text).substr(begin, end - begin), [&](std::string word) {
      if (complete) return;
      if (word != "{" && word != "}") {
        if (statement.size() < kMaxWords) statement.push_back(std::move(word));
        return;
      }
      read(statement);
      statement.clear();
      depth += word == "{" ? 1 : -1;
      complete = depth == 0 && found;
    });
    read(statement);
    begin = end + 1;
  }
  return found;
}

// In a folder that the <script> names, or beside the file that names the picture.
std::string texture_file(const std::string& name, const std::string& file, const Element& script,
                         Session& session) {
  for (const Element& uri : script.children) {
    if (uri.name != "uri") continue;
    const auto folder = find_uri(uri.text, uri.source.file, session);
    if (!folder) continue;
    std::string path = (fs::path(*folder) / name).lexically_normal().string();
    if (is_plain_file(path) && session.allowed.holds(path, uri.source.file)) return path;
  }
  return find_beside(name, "texture", file, script.source, session);
}

}  // namespace

std::optional<OgreMaterial> Gazebo::ogre_material(const std::string& path, const Element& uri,
                                                  const Element& script, Session& session) const {
  for (const std::string& file : scripts_at(path)) {
    if (!session.allowed.holds(file, uri.source.file)) continue;
    std::optional<OgreMaterial> found = material_in(read_file(file), script.child_text("name"));
    if (!found) continue;
    if (!found->texture.empty()) {
      found->texture = texture_file(found->texture, file, script, session);
    }
    return found;
  }
  return std::nullopt;
}

}  // namespace angen::load
