#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace angen::sim {

/// An array whose copies share what did not change: a copy costs a pointer for each 2048 elements,
/// a change after a copy one chunk of 64 and the pointers to 32 chunks.
template <class T>
class SharedArray {
 public:
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  const T& operator[](std::size_t i) const {
    return (*(*blocks_[i / kBlock])[i % kBlock / kChunk])[i % kChunk];
  }

  void set(std::size_t i, T value) {
    Block& block = own(blocks_[i / kBlock]);
    Chunk& chunk = own(block[i % kBlock / kChunk]);
    chunk[i % kChunk] = std::move(value);
  }

  void push_back(T value) {
    if (size_ % kBlock == 0) blocks_.push_back(std::make_shared<Block>());
    if (size_ % kChunk == 0) {
      own(blocks_.back())[size_ % kBlock / kChunk] = std::make_shared<Chunk>();
    }
    set(size_++, std::move(value));
  }

  void clear() {
    blocks_.clear();
    size_ = 0;
  }

 private:
  static constexpr std::size_t kChunk = 64;
  static constexpr std::size_t kBlock = 32 * kChunk;
  using Chunk = std::array<T, kChunk>;
  using Block = std::array<std::shared_ptr<Chunk>, kBlock / kChunk>;

  // What a copy shares is copied before it is changed.
  template <class Part>
  static Part& own(std::shared_ptr<Part>& part) {
    if (part.use_count() > 1) part = std::make_shared<Part>(*part);
    return *part;
  }

  std::vector<std::shared_ptr<Block>> blocks_;
  std::size_t size_ = 0;
};

}  // namespace angen::sim
