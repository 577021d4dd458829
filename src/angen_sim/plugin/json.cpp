#include "plugin/json.h"

#include <charconv>
#include <cmath>

namespace angen {

namespace {

std::string quoted(const std::string& text) {
  constexpr char kHex[] = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20) {
      out += "\\u00";
      out += kHex[byte >> 4];
      out += kHex[byte & 15];
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string json(const std::string& text) { return quoted(text); }
std::string json(const char* text) { return quoted(text); }
std::string json(bool value) { return value ? "true" : "false"; }

std::string json(double value) {
  if (!std::isfinite(value)) return "null";
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string json(int value) { return std::to_string(value); }

/// {"key": value, …} from key, value, key, value, …
template <class... Rest>
std::string members(const char* key, const std::string& value, Rest&&... rest) {
  std::string text = quoted(key) + ": " + value;
  if constexpr (sizeof...(rest) > 0) text += ", " + members(std::forward<Rest>(rest)...);
  return text;
}

template <class T, class F>
std::string list(const std::vector<T>& values, F&& each) {
  std::string text = "[";
  for (const T& value : values) text += (text.size() > 1 ? ", " : "") + each(value);
  return text + "]";
}

std::string list(const std::vector<std::string>& texts) { return list(texts, quoted); }

std::string object(const ParamDoc& p) {
  return "{" +
         members("path", json(p.path), "type", json(p.type), "default", json(p.fallback), "unit",
                 json(p.unit), "doc", json(p.doc), "choices", list(p.choices)) +
         "}";
}

std::string object(const Verb& v) {
  const char* type = v.argument.empty() ? "" : v.whole ? "integer" : "number";
  return "{" +
         members("name", json(v.name), "doc", json(v.doc), "argument", json(v.argument), "type",
                 json(type), "unit", json(v.unit), "min", json(v.range.min), "max",
                 json(v.range.max), "count",
                 json(static_cast<int>(v.argument.empty() ? 0 : v.count)), "place",
                 json(v.is_place), "optional", json(v.is_optional)) +
         "}";
}

// The events after which a flag is yes, and no.
std::vector<std::string> events_of(const Field& f) {
  if (f.begin_event.empty()) return {};
  if (f.in_alarm) return {f.begin_event, f.end_event};
  return {f.end_event, f.begin_event};
}

std::string object(const Field& f) {
  return "{" +
         members("name", json(f.name), "type", json(name_of(f.type)), "unit", json(f.unit), "doc",
                 json(f.doc), "words", list(f.words), "shown", json(f.in_summary), "decimals",
                 json(f.decimals), "alarm", json(f.alarm), "events", list(events_of(f)), "with",
                 json(f.with)) +
         "}";
}

std::string object(const Kind::Model& m) {
  return "{" +
         members("model", json(m.folder), "parameter", json(m.parameter), "value", json(m.value)) +
         "}";
}

std::string object(const PluginDoc& plugin) {
  const Kind& kind = plugin.kind;
  const auto each = [](const auto& value) { return object(value); };
  return "{" +
         members("library", json(plugin.library), "kind", json(kind.name), "doc", json(kind.doc),
                 "role", json(plugin.is_device ? "device" : "sensor"), "rate", json(kind.rate()),
                 "on_demand", json(kind.is_on_demand), "models", list(kind.models, each),
                 "sensor_type", json(kind.sensor_type()), "example", json(kind.example()),
                 "command_topic", json(kind.command_topic()), "verbs", list(kind.verbs, each),
                 "values", list(kind.value_units()), "fields", list(kind.fields, each), "params",
                 list(plugin.params, each)) +
         "}";
}

}  // namespace

std::string to_json(const std::vector<PluginDoc>& plugins) {
  std::string text = "[";
  for (const PluginDoc& plugin : plugins) text += (text.size() > 1 ? ",\n" : "\n") + object(plugin);
  return text + "\n]\n";
}

}  // namespace angen
