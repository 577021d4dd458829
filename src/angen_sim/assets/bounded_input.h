#pragma once

#include <cereal/archives/binary.hpp>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace angen::load {
class BoundedInput;
}

template <>
struct cereal::traits::detail::get_output_from_input<angen::load::BoundedInput> {
  using type = cereal::BinaryOutputArchive;
};

namespace angen::load {

/// Reads the output of cereal::BinaryOutputArchive. Sizes are compared with the bytes that are
/// left before memory is taken for them: damaged bytes throw cereal::Exception and cost little.
class BoundedInput : public cereal::InputArchive<BoundedInput, cereal::AllowEmptyClassElision> {
 public:
  explicit BoundedInput(std::string_view bytes) : InputArchive(this), left_(bytes) {}

  void need(std::uint64_t bytes) const {
    if (bytes > left_.size()) throw cereal::Exception("the bytes end early");
  }
  bool at_end() const { return left_.empty(); }
  void read(void* data, std::uint64_t size) {
    need(size);
    if (size > 0) std::memcpy(data, left_.data(), size);
    left_.remove_prefix(size);
  }

 private:
  std::string_view left_;
};

template <class T>
std::enable_if_t<std::is_arithmetic_v<T>> CEREAL_LOAD_FUNCTION_NAME(BoundedInput& archive,
                                                                    T& value) {
  archive.read(&value, sizeof value);
}

inline void CEREAL_LOAD_FUNCTION_NAME(BoundedInput& archive, bool& value) {
  std::uint8_t byte = 0;
  archive.read(&byte, 1);
  if (byte > 1) throw cereal::Exception("a flag that is neither 0 nor 1");
  value = byte == 1;
}

template <class T>
void CEREAL_SERIALIZE_FUNCTION_NAME(BoundedInput& archive, cereal::NameValuePair<T>& pair) {
  archive(pair.value);
}

template <class T>
void CEREAL_SERIALIZE_FUNCTION_NAME(BoundedInput& archive, cereal::SizeTag<T>& tag) {
  archive(tag.size);
  archive.need(tag.size);  // each element takes a byte or more
}

template <class T>
void CEREAL_LOAD_FUNCTION_NAME(BoundedInput& archive, cereal::BinaryData<T>& data) {
  archive.read(data.data, static_cast<std::uint64_t>(data.size));
}

}  // namespace angen::load
