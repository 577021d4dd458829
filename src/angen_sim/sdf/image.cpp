#include <algorithm>

#include "assets/mesh.h"
#include "core/text.h"
#include "document/search.h"
#include "sdf/geometry.h"

namespace angen::load {

namespace {

constexpr std::size_t kMaxBoxes = 1000;
constexpr double kThreshold = 200.0;  // SDF's default, of kWhite
constexpr double kWhite = 255.0;

// Square cells of an image, from its top left; those at the right and the bottom may be cut.
struct Cells {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<bool> solid;

  bool all(std::size_t row, std::size_t begin, std::size_t end) const {
    for (std::size_t column = begin; column < end; ++column) {
      if (!solid[row * columns + column]) return false;
    }
    return true;
  }
};

struct Rectangle {
  std::size_t left, right, top, bottom;  // cells; right and bottom are the first outside
};

// A cell is solid where at least half of its pixels are at or below the threshold.
Cells cells_of(const GrayImage& image, std::size_t side, double threshold) {
  Cells cells;
  cells.columns = (image.width + side - 1) / side;
  cells.rows = (image.height + side - 1) / side;
  std::vector<std::size_t> pixels(cells.columns * cells.rows, 0);
  std::vector<std::size_t> dark(pixels);
  for (std::size_t y = 0; y < image.height; ++y) {
    for (std::size_t x = 0; x < image.width; ++x) {
      const std::size_t cell = y / side * cells.columns + x / side;
      ++pixels[cell];
      if (image.values[y * image.width + x] * kWhite <= threshold + 1e-9) ++dark[cell];
    }
  }
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    cells.solid.push_back(dark[i] > 0 && 2 * dark[i] >= pixels[i]);
  }
  return cells;
}

// Covers the solid cells: each rectangle grows to the right, then down, as far as all is solid.
std::vector<Rectangle> rectangles_of(Cells cells) {
  std::vector<Rectangle> found;
  for (std::size_t row = 0; row < cells.rows; ++row) {
    for (std::size_t column = 0; column < cells.columns; ++column) {
      if (!cells.solid[row * cells.columns + column]) continue;
      Rectangle rectangle{column, column + 1, row, row + 1};
      while (rectangle.right < cells.columns &&
             cells.all(row, rectangle.right, rectangle.right + 1))
        ++rectangle.right;
      while (rectangle.bottom < cells.rows &&
             cells.all(rectangle.bottom, rectangle.left, rectangle.right))
        ++rectangle.bottom;
      for (std::size_t r = rectangle.top; r < rectangle.bottom; ++r) {
        for (std::size_t c = rectangle.left; c < rectangle.right; ++c) {
          cells.solid[r * cells.columns + c] = false;
        }
      }
      found.push_back(rectangle);
    }
  }
  return found;
}

std::size_t granularity_of(const Reader& element) {
  const double value = element.number("granularity", 1.0, Range::positive());
  if (value >= 1.0 && value <= 1000.0 && value == static_cast<double>(static_cast<int>(value))) {
    return static_cast<std::size_t>(value);
  }
  throw Error(element.child("granularity")->source,
              "<granularity> is not a whole number of pixels from 1 to 1000");
}

}  // namespace

std::vector<PlacedShape> image_boxes(const Reader& reader, const Pose& pose, Session& session) {
  const Element& element = reader.element();
  const Element& uri = reader.need("uri");
  const std::string file = need_uri(uri.text, "image", uri.source, session);
  const GrayImage image = read_png(file, "image", 1, uri.source);
  const double threshold = reader.number("threshold", kThreshold, Range::not_negative());
  if (!(threshold >= 0.0 && threshold <= kWhite)) {
    throw Error(element.source, "<threshold> is " + number_text(threshold) +
                                    "; it must be 0, black, to 255, white");
  }
  const std::size_t side = granularity_of(reader);
  const std::vector<Rectangle> rectangles = rectangles_of(cells_of(image, side, threshold));
  if (rectangles.empty()) {
    throw Error(element.source, "no part of " + file + " is as dark as the <threshold> " +
                                    std::to_string(static_cast<int>(threshold)) +
                                    "; give a higher one, up to 255");
  }
  if (rectangles.size() > kMaxBoxes) {
    throw Error(element.source, file + " gives " + std::to_string(rectangles.size()) +
                                    " boxes, more than " + std::to_string(kMaxBoxes) +
                                    "; give a larger <granularity>, or a simpler image");
  }
  const double scale = reader.number("scale", 1.0, Range::positive());
  const double height = reader.number("height", 1.0, Range::positive());
  const auto along = [&](std::size_t cell, unsigned pixels) {  // m from the image's middle
    return scale * (std::min<double>(static_cast<double>(cell * side), pixels) - 0.5 * pixels);
  };
  std::vector<PlacedShape> boxes;
  for (const Rectangle& r : rectangles) {
    const double x0 = along(r.left, image.width), x1 = along(r.right, image.width);
    const double y0 = along(r.top, image.height), y1 = along(r.bottom, image.height);
    PlacedShape box;
    box.shape.type = Shape::Type::kBox;
    box.shape.size = {x1 - x0, y1 - y0, height};
    box.pose = pose * Pose{{0.5 * (x0 + x1), -0.5 * (y0 + y1), 0.5 * height}, Quat::Identity()};
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace angen::load
