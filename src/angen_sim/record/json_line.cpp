#include "record/json_line.h"

#include <rapidjson/document.h>
#include <rapidjson/error/en.h>
#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <algorithm>
#include <charconv>

#include "core/random.h"
#include "record/fingerprint.h"

namespace angen::record {

namespace {

// The values of a command may be infinite or NaN; texts may hold any bytes.
constexpr unsigned kWriteFlags = rapidjson::kWriteNanAndInfFlag;
constexpr unsigned kParseFlags = rapidjson::kParseNumbersAsStringsFlag |
                                 rapidjson::kParseNanAndInfFlag | rapidjson::kParseIterativeFlag;
constexpr std::size_t kSumEnd = 26;  // bytes of the text of ends_with()

std::string ends_with(std::uint64_t sum) { return ",\"sum\":\"" + fingerprint_text(sum) + "\"}"; }

using Json = rapidjson::Writer<rapidjson::StringBuffer, rapidjson::UTF8<>, rapidjson::UTF8<>,
                               rapidjson::CrtAllocator, kWriteFlags>;

void put(bool value, Json& json) { json.Bool(value); }
void put(std::uint64_t value, Json& json) { json.Uint64(value); }
void put(double value, Json& json) { json.Double(value); }
void put(const std::string& value, Json& json) {
  json.String(value.data(), static_cast<rapidjson::SizeType>(value.size()));
}
template <class T>
void put(const std::vector<T>& values, Json& json) {
  json.StartArray();
  for (const T& value : values) put(value, json);
  json.EndArray();
}

}  // namespace

struct LineWriter::Impl {
  rapidjson::StringBuffer buffer;
  Json json{buffer};
};

LineWriter::LineWriter() : impl_(std::make_unique<Impl>()) { impl_->json.StartObject(); }

LineWriter::~LineWriter() = default;

LineWriter& LineWriter::add(const char* key, const LineValue& value) {
  impl_->json.Key(key);
  std::visit([this](const auto& held) { put(held, impl_->json); }, value);
  return *this;
}

std::string LineWriter::done(std::uint64_t& sum) {
  std::string line(impl_->buffer.GetString(), impl_->buffer.GetSize());
  sum = hash_bytes(line, sum);
  return line + ends_with(sum) + "\n";
}

namespace {

/// Converts numbers itself: RapidJSON reads outside of a table for one with hundreds of zeros.
class Document : public rapidjson::Document {
 public:
  /// Empty if all of the line is JSON.
  rapidjson::ParseResult read(const std::string& line) {
    rapidjson::MemoryStream stream(line.data(), line.size());
    rapidjson::Reader reader;
    rapidjson::ParseResult result;
    const auto fill = [&](rapidjson::Document&) {
      result = reader.Parse<kParseFlags>(stream, *this);
      return !result.IsError();
    };
    Populate(fill);
    return result;
  }

  /// The reader calls this instead of the base's, which would make it a text.
  bool RawNumber(const char* text, rapidjson::SizeType length, bool /*copy*/) {
    const char* const end = text + length;
    std::uint64_t whole = 0;
    if (const auto done = std::from_chars(text, end, whole);
        done.ec == std::errc() && done.ptr == end) {
      return Uint64(whole);
    }
    double number = 0.0;
    const auto done = std::from_chars(text, end, number);
    return done.ec == std::errc() && done.ptr == end && Double(number);
  }
};

std::string reason(const rapidjson::ParseResult& wrong) {
  if (wrong.Code() == rapidjson::kParseErrorTermination) return "A number that no double can hold.";
  return rapidjson::GetParseError_En(wrong.Code());
}

}  // namespace

struct LineReader::Impl {
  const std::string& line;
  Source at;
  std::uint64_t byte;
  Document json{};
};

LineReader::LineReader(const std::string& line, const Source& at, std::uint64_t byte)
    : impl_(new Impl{line, at, byte}) {
  if (const rapidjson::ParseResult result = impl_->json.read(line); result.IsError()) {
    throw Error(at, "is damaged at byte " + std::to_string(byte + result.Offset()) +
                        " of the file: " + reason(result));
  }
  if (!impl_->json.IsObject()) fail("not a JSON object");
}

LineReader::~LineReader() = default;

void LineReader::check(std::uint64_t& sum) const {
  const std::string& line = impl_->line;
  if (line.size() < kSumEnd) fail("the line has no checksum");
  const std::size_t end = line.size() - kSumEnd;
  sum = hash_bytes(std::string_view(line).substr(0, end), sum);
  if (line.compare(end, kSumEnd, ends_with(sum)) != 0) {
    fail("its checksum is not that of this line and those before it");
  }
}

void LineReader::fail(const std::string& what) const {
  throw Error(impl_->at, "is damaged, the line that begins at byte " + std::to_string(impl_->byte) +
                             " of the file: " + what);
}

namespace {

// Whether a value is of the type; it is taken then.
bool take(const rapidjson::Value& from, bool& to) {
  return from.IsBool() && (to = from.GetBool(), true);
}
bool take(const rapidjson::Value& from, std::uint64_t& to) {
  return from.IsUint64() && (to = from.GetUint64(), true);
}
bool take(const rapidjson::Value& from, double& to) {
  return from.IsNumber() && (to = from.GetDouble(), true);
}
bool take(const rapidjson::Value& from, std::string& to) {
  return from.IsString() && (to.assign(from.GetString(), from.GetStringLength()), true);
}
template <class T>
bool take(const rapidjson::Value& from, std::vector<T>& to) {
  if (!from.IsArray()) return false;
  to.resize(from.Size());
  return std::equal(from.Begin(), from.End(), to.begin(),
                    [](const rapidjson::Value& part, T& value) { return take(part, value); });
}

}  // namespace

bool LineReader::has(const char* key) const { return impl_->json.HasMember(key); }

template <class T>
T LineReader::get(const char* key) const {
  constexpr const char* kTypes[] = {"true or false",     "a whole number of at least 0",
                                    "a number",          "a text",
                                    "a list of numbers", "a list of texts"};
  T value{};
  const auto found = impl_->json.FindMember(key);
  if (found == impl_->json.MemberEnd() || !take(found->value, value)) {
    fail("'" + std::string(key) + "' is missing, or not " + kTypes[LineValue(value).index()]);
  }
  return value;
}

template bool LineReader::get(const char*) const;
template std::uint64_t LineReader::get(const char*) const;
template double LineReader::get(const char*) const;
template std::string LineReader::get(const char*) const;
template std::vector<double> LineReader::get(const char*) const;
template std::vector<std::string> LineReader::get(const char*) const;

}  // namespace angen::record
