#include "import/ogre.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <vector>

#include "core/plain_file.h"
#include "core/text.h"
#include "document/search.h"

namespace angen::load {

namespace fs = std::filesystem;

namespace {

// A line's words; braces stand for themselves, and a comment ends it.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words(1);
  const std::size_t end = std::min(line.find("//"), line.size());
  bool quoted = false;
  for (std::size_t i = 0; i < end; ++i) {
    const char c = line[i];
    if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && (c == '{' || c == '}')) {
      words.insert(words.end(), {std::string(1, c), ""});
    } else if (!quoted && (c == ' ' || c == '\t' || c == '\r')) {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  words.erase(std::remove(words.begin(), words.end(), ""), words.end());
  return words;
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

std::vector<std::string> scripts_at(const std::string& path, Session& session) {
  std::vector<std::string> files;
  std::error_code failed;
  const auto add = [&](const fs::path& file) {
    if (is_plain_file(file.string())) files.push_back(file.string());
  };
  if (!session.sources.is_folder(path)) {
    add(path);
    return files;
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(path, failed)) {
    if (entry.path().extension() == ".material") add(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::optional<OgreMaterial> ogre_material(const std::string& text, const std::string& name) {
  std::optional<OgreMaterial> found;
  int depth = 0;
  const auto read = [&](const std::vector<std::string>& words) {
    if (words.size() < 2) return;
    if (depth == 0 && !found && words[0] == "material" && words[1] == name) found.emplace();
    if (depth == 0 || !found) return;
    if (words[0] == "diffuse" && !found->diffuse) found->diffuse = color_in(words);
    if (words[0] == "texture" && found->texture.empty()) found->texture = words[1];
  };
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> statement;
    for (const std::string& word : words_of(line)) {
      if (word != "{" && word != "}") {
        statement.push_back(word);
        continue;
      }
      read(statement);
      statement.clear();
      depth += word == "{" ? 1 : -1;
      if (depth == 0 && found) return found;
    }
    read(statement);
  }
  return found;
}

std::optional<OgreMaterial> ogre_material(const Element& uri, const std::string& name,
                                          Session& session) {
  const auto path = find_uri(uri.text, uri.source.file, session);
  if (!path) return std::nullopt;  // Gazebo's own, as a rule
  for (const std::string& file : scripts_at(*path, session)) {
    if (!session.allowed.holds(file, uri.source.file)) continue;
    std::optional<OgreMaterial> found = ogre_material(session.sources.read(file), name);
    if (!found) continue;
    found->file = file;
    return found;
  }
  return std::nullopt;
}

std::string ogre_texture(const Element& script, const OgreMaterial& material, Session& session) {
  for (const Element& uri : script.children) {
    if (uri.name != "uri") continue;
    const auto folder = find_uri(uri.text, uri.source.file, session);
    if (!folder || !session.sources.is_folder(*folder)) continue;
    std::string path = (fs::path(*folder) / material.texture).lexically_normal().string();
    if (!session.sources.exists(path) || !is_plain_file(path)) continue;
    if (session.allowed.holds(path, uri.source.file)) return path;
  }
  return find_beside(material.texture, "texture", material.file, script.source, session);
}

}  // namespace angen::load
