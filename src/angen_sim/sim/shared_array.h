#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace angen::sim {

/// An array whose copies share unchanged elements: a copy costs a pointer for each 2048 elements,
/// a change after a copy one chunk of 64 and the pointers to 32 chunks.
template <class T>
class SharedArray {
 public:
  class Iterator {
   public:
    using iterator_category = std::random_access_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = const T*;
    using reference = const T&;

    Iterator(const SharedArray& array, std::size_t at) : array_(&array), at_(at) {}
    reference operator*() const { return (*array_)[at_]; }
    pointer operator->() const { return &**this; }
    Iterator& operator++() { return *this += 1; }
    Iterator& operator--() { return *this += -1; }
    Iterator& operator+=(difference_type by) {
      at_ += by;
      return *this;
    }
    Iterator operator+(difference_type by) const { return Iterator(*this) += by; }
    difference_type operator-(const Iterator& o) const {
      return static_cast<difference_type>(at_ - o.at_);
    }
    bool operator==(const Iterator& o) const { return at_ == o.at_; }
    bool operator!=(const Iterator& o) const { return at_ != o.at_; }

   private:
    const SharedArray* array_;
    std::size_t at_;
  };

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size_}; }
  const T& back() const { return (*this)[size_ - 1]; }

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

  /// Keeps the first `size` elements, of which there are that many.
  void truncate(std::size_t size) {
    size_ = size;
    blocks_.resize((size + kBlock - 1) / kBlock);
    if (size % kBlock == 0) return;
    Block& last = own(blocks_.back());
    for (std::size_t i = (size % kBlock + kChunk - 1) / kChunk; i < last.size(); ++i) {
      last[i] = nullptr;
    }
    if (size % kChunk == 0) return;
    Chunk& chunk = own(last[size % kBlock / kChunk]);
    std::fill(chunk.begin() + size % kChunk, chunk.end(), T());
  }

 private:
  static constexpr std::size_t kChunk = 64;
  static constexpr std::size_t kBlock = 32 * kChunk;
  using Chunk = std::array<T, kChunk>;
  using Block = std::array<std::shared_ptr<Chunk>, kBlock / kChunk>;

  // Shared elements are copied before they are changed.
  template <class Part>
  static Part& own(std::shared_ptr<Part>& part) {
    if (part.use_count() > 1) part = std::make_shared<Part>(*part);
    return *part;
  }

  std::vector<std::shared_ptr<Block>> blocks_;
  std::size_t size_ = 0;
};

}  // namespace angen::sim
