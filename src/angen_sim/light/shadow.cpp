#include "light/shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "light/beam.h"
#include "light/directions.h"

namespace angen::light {
namespace {

constexpr double kSunlit = 1e4;            // m, length of shadow rays to a directional lamp
constexpr int kCoarsest = 4, kFinest = 7;  // levels of cells: 4^level of them fill the square
constexpr int kSlenderest = 3;             // 4^3 more columns than rows, or fewer
constexpr double kClose = 0.35;            // diagonal of a cell by its distance
constexpr double kShareError = 0.004;      // error of the visible share, one standard deviation
constexpr double kLuxError = 0.01;         // lx at level 1
// A cell at the edge of a shadow, of which any share may be visible, is sampled once.
constexpr double kVariance = 0.1;

// Directions to a close lamp (R2, M. Roberts 2018: powers of the inverse plastic number).
constexpr std::size_t kTries = 64;
constexpr double kFirstStep = 0.7548776662466927, kSecondStep = 0.5698402909980532;

using Square = std::pair<double, double>;

/// Maps the unit square to the unit disc; keeps areas and neighbors (Shirley and Chiu 1997).
Eigen::Vector2d on_disc(const Square& at) {
  const double x = 2.0 * at.first - 1.0, y = 2.0 * at.second - 1.0;
  if (x == 0.0 && y == 0.0) return Eigen::Vector2d::Zero();
  const bool wide = std::abs(x) > std::abs(y);
  const double out = wide ? x : y;
  const double angle = wide ? M_PI / 4 * y / x : M_PI / 2 - M_PI / 4 * x / y;
  return {out * std::cos(angle), out * std::sin(angle)};
}

/// A lamp as a point sees it: the unit square covers all that could be visible.
class Face {
 public:
  Face(const Lamp& lamp, const Vec3& point, const Vec3& normal)
      : lamp_(lamp), point_(point), normal_(normal), middle_(lamp.pose.position) {
    const Vec3 towards = middle_ - point;
    distance_ = towards.norm();
    if (lamp.type == Lamp::Type::kTube) {
      along_ = axes_of(lamp).along;
      const Vec3 across = along_.cross(towards - towards.dot(along_) * along_);
      across_ = across.norm() > 0.0 ? Vec3(across.normalized()) : axes_of(lamp).across;
      shines_ = along_.cross(across_);  // to the point
      extent_ = {lamp.length, 2.0 * lamp.radius};
    } else if (lamp.flat()) {
      along_ = axes_of(lamp).along;
      across_ = axes_of(lamp).across;
      shines_ = lamp.pose.rotation * lamp.direction;
      extent_ = lamp.type == Lamp::Type::kDisc ? Eigen::Vector2d::Constant(2.0 * lamp.radius)
                                               : Eigen::Vector2d(lamp.width, lamp.height);
    } else if (lamp.type != Lamp::Type::kDirectional && distance_ > lamp.radius &&
               lamp.radius > 0.0) {
      frame_ = frame_about(towards / distance_);
      const double sine = lamp.radius / distance_;
      cap_ = sine * sine / (1.0 + std::sqrt(1.0 - sine * sine));
    }
  }

  /// Or in one direction.
  bool is_point() const { return !lamp_.flat() && lamp_.type != Lamp::Type::kTube && cap_ == 0.0; }
  bool flat() const { return lamp_.flat(); }

  /// The lamp's surface there; m, world.
  Vec3 at(const Square& in_square) const {
    if (is_point()) return middle_;
    if (lamp_.type == Lamp::Type::kDisc) {
      const Eigen::Vector2d disc = lamp_.radius * on_disc(in_square);
      return middle_ + disc.x() * along_ + disc.y() * across_;
    }
    if (!lamp_.flat() && lamp_.type != Lamp::Type::kTube) return on_globe(in_square);
    const double across = (in_square.second - 0.5) * extent_.y();
    const Vec3 on_plane =
        middle_ + (in_square.first - 0.5) * extent_.x() * along_ + across * across_;
    if (lamp_.flat()) return on_plane;
    const double rise = lamp_.radius * lamp_.radius - across * across;
    return on_plane + std::sqrt(std::max(0.0, rise)) * shines_;
  }

  /// The center of a globe, the nearest point of a tube's axis.
  Vec3 inside(const Vec3& on_lamp) const {
    return middle_ + (on_lamp - middle_).dot(along_) * along_;
  }

  /// Light that arrives from there, up to a factor of the lamp; the point of at().
  double weight(const Vec3& on_lamp) const {
    const Vec3 way = on_lamp - point_;
    const double facing = way.dot(normal_);
    if (lamp_.flat()) {
      const double squared = way.squaredNorm();
      return std::max(0.0, facing) * std::max(0.0, -way.dot(shines_)) / (squared * squared);
    }
    if (lamp_.type == Lamp::Type::kTube) {
      const double squared = way.squaredNorm();
      return std::max(0.0, facing) * way.cross(along_).norm() / (squared * squared);
    }
    if (lamp_.type != Lamp::Type::kPoint || lamp_.photometry) return 1.0;
    return std::max(0.0, facing) / way.norm();
  }

  /// Binary digits by which its columns are more than its rows of square cells, halved.
  int slenderness() const {
    if (extent_.minCoeff() <= 0.0) return 0;
    const double halved = std::log2(extent_.x() / extent_.y()) / 2.0;
    return std::clamp(static_cast<int>(std::lround(halved)), -kSlenderest, kSlenderest);
  }

  /// Whether a cell of that size in the square is large for its distance.
  bool close(const Square& middle, const Square& size) const {
    const double diagonal = std::hypot(extent_.x() * size.first, extent_.y() * size.second);
    return diagonal > kClose * (at(middle) - point_).norm();
  }

 private:
  /// The cap that the point sees, by solid angle.
  Vec3 on_globe(const Square& in_square) const {
    const Eigen::Vector2d disc = on_disc(in_square);
    const double lower = disc.squaredNorm() * cap_;  // 1 - cosine
    const double scale = std::sqrt(cap_ * (2.0 - lower));
    const Vec3 way = frame_ * Vec3(disc.x() * scale, disc.y() * scale, 1.0 - lower);
    const double along = distance_ * (1.0 - lower);
    const double off2 = distance_ * distance_ * lower * (2.0 - lower);
    const double inside = std::sqrt(std::max(0.0, lamp_.radius * lamp_.radius - off2));
    return point_ + (along - inside) * way;
  }

  const Lamp& lamp_;
  Vec3 point_, normal_, middle_;
  Vec3 along_ = Vec3::Zero(), across_ = Vec3::Zero(), shines_ = Vec3::Zero();
  Eigen::Vector2d extent_ = Eigen::Vector2d::Zero();  // m
  Eigen::Matrix3d frame_ = Eigen::Matrix3d::Identity();
  double distance_ = 0.0;
  double cap_ = 0.0;  // a globe's: 1 - cosine of the cone in which it is seen
};

/// Sobol's first two dimensions: of the first 2^n points, each cell of a grid of 2^k x 2^(n - k)
/// has one, for every k.
struct CellPoints {
  static constexpr std::size_t kCount = std::size_t{1} << (2 * kFinest);
  using Grids = std::array<std::vector<std::uint16_t>, kFinest + 1>;  // by level, row by row

  std::array<Square, kCount> points;
  std::array<Grids, 2 * kSlenderest + 1> in_cell;  // by slenderness + kSlenderest

  CellPoints() {
    for (std::uint32_t i = 0; i < kCount; ++i) {
      // A digital shift, so that no point is on a corner.
      const std::uint32_t x = reversed(i) ^ 0x5bd1e995U, y = second(i) ^ 0x2c1b3c6dU;
      points[i] = {(x + 0.5) * 0x1p-32, (y + 0.5) * 0x1p-32};
    }
    for (int slender = -kSlenderest; slender <= kSlenderest; ++slender) {
      for (int level = kCoarsest; level <= kFinest; ++level) fill(slender, level);
    }
  }

  std::uint16_t at(int slender, int level, int column, int row) const {
    const Grids& grids = in_cell[static_cast<std::size_t>(slender + kSlenderest)];
    return grids[static_cast<std::size_t>(level)]
                [static_cast<std::size_t>((row << (level + slender)) + column)];
  }

 private:
  static std::uint32_t reversed(std::uint32_t i) {
    std::uint32_t out = 0;
    for (std::uint32_t bit = 1U << 31; i != 0; i >>= 1, bit >>= 1) out |= (i & 1U) != 0 ? bit : 0;
    return out;
  }
  void fill(int slender, int level) {
    auto& grid =
        in_cell[static_cast<std::size_t>(slender + kSlenderest)][static_cast<std::size_t>(level)];
    grid.resize(std::size_t{1} << (2 * level));
    for (std::uint32_t i = 0; i < grid.size(); ++i) {
      const auto column = static_cast<std::size_t>(points[i].first * (1 << (level + slender)));
      const auto row = static_cast<std::size_t>(points[i].second * (1 << (level - slender)));
      grid[(row << (level + slender)) + column] = static_cast<std::uint16_t>(i);
    }
  }
  static std::uint32_t second(std::uint32_t i) {
    std::uint32_t out = 0;
    for (std::uint32_t v = 1U << 31; i != 0; i >>= 1, v ^= v >> 1) out ^= (i & 1U) != 0 ? v : 0;
    return out;
  }
};

const CellPoints& cell_points() {
  static const CellPoints all;
  return all;
}

struct Cell {
  int level = 0;
  int column = 0, row = 0;
  std::uint16_t point = 0;  // index in CellPoints
  bool counts = false;      // false inside a ceiling
  bool seen = false;
  bool at_edge = false;  // a neighbor differs
  double weight = 0.0;
};

/// The cells of a lamp's face, each with one sample.
class Cells {
 public:
  Cells(const rays::Scene& scene, const Lamp& lamp, const Face& face, const Vec3& point,
        rays::Mobilities among)
      : scene_(scene),
        lamp_(lamp),
        face_(face),
        point_(point),
        among_(among),
        slender_(face.slenderness()) {
    cells_.reserve(std::size_t{1} << (2 * kCoarsest));
    for (int row = 0; row < rows(kCoarsest); ++row) {
      for (int column = 0; column < columns(kCoarsest); ++column) {
        add(kCoarsest, column, row, nullptr);
      }
    }
  }

  double share() const { return free_ > 0.0 ? seen_ / free_ : 0.0; }
  bool partly() const { return seen_ > 0.0 && seen_ < free_; }

  /// Divides the cells at edges until the share is as accurate as `error` and kShareError allow.
  void refine(double error) {
    if (face_.flat()) {  // slats before a window are finer than the first cells
      for (Cell& cell : cells_) cell.at_edge = true;
      divide();
    }
    while (find_edges() > std::max(error * free_, kShareError * seen_) && divide()) {
    }
  }

 private:
  int columns(int level) const { return 1 << (level + slender_); }
  int rows(int level) const { return 1 << (level - slender_); }

  void add(int level, int column, int row, const Cell* parent) {
    const Square size{1.0 / columns(level), 1.0 / rows(level)};
    if (parent == nullptr && level < kFinest && face_.flat() &&
        face_.close({(column + 0.5) * size.first, (row + 0.5) * size.second}, size)) {
      for (const int child : {0, 1, 2, 3}) {
        add(level + 1, 2 * column + child % 2, 2 * row + child / 2, nullptr);
      }
      return;
    }
    finest_ = std::max(finest_, level);
    Cell cell;
    cell.level = level;
    cell.column = column;
    cell.row = row;
    cell.point = cell_points().at(slender_, level, column, row);
    const Vec3 on_lamp = face_.at(cell_points().points[cell.point]);
    cell.weight = face_.weight(on_lamp) * size.first * size.second;
    if (parent != nullptr && parent->point == cell.point) {
      cell.seen = parent->seen;
      cell.counts = parent->counts;
    } else if (cell.weight > 0.0) {
      cell.seen = !scene_.blocked(point_, on_lamp, 1e-4, among_);
      // A sample point inside a ceiling counts neither as seen nor as shadowed.
      cell.counts =
          cell.seen || lamp_.flat() || !scene_.blocked(lamp_.pose.position, on_lamp, 0.0, among_);
    }
    sum(cell, 1.0);
    cells_.push_back(cell);
  }

  void sum(const Cell& cell, double sign) {
    if (!cell.counts) return;
    free_ += sign * cell.weight;
    if (cell.seen) seen_ += sign * cell.weight;
  }

  /// Compares all neighbors. Returns the standard deviation of the sum of seen weights.
  double find_edges() {
    const int width = columns(finest_), height = rows(finest_);
    raster_.resize(static_cast<std::size_t>(width * height));
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const Cell& cell = cells_[i];
      const int size = 1 << (finest_ - cell.level);
      for (int row = cell.row * size; row < (cell.row + 1) * size; ++row) {
        std::fill_n(raster_.begin() + row * width + cell.column * size, size,
                    static_cast<std::uint16_t>(i));
      }
    }
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        const int at = row * width + column;
        const bool right = column + 1 < width, down = row + 1 < height;
        if (right) compare(at, at + 1);
        if (down) compare(at, at + width);
        if (right && down) compare(at, at + width + 1);
        if (down && column > 0) compare(at, at + width - 1);
      }
    }
    double variance = 0.0;
    for (const Cell& cell : cells_) {
      if (cell.at_edge) variance += kVariance * cell.weight * cell.weight;
    }
    return std::sqrt(variance);
  }

  void compare(int a, int b) {
    Cell &first = cells_[raster_[static_cast<std::size_t>(a)]],
         &second = cells_[raster_[static_cast<std::size_t>(b)]];
    if (first.seen == second.seen || !first.counts || !second.counts) return;
    first.at_edge = second.at_edge = true;
  }

  /// Returns whether any cell could be divided.
  bool divide() {
    std::vector<Cell> before;
    before.swap(cells_);
    bool any = false;
    for (Cell& cell : before) {
      const bool split = std::exchange(cell.at_edge, false) && cell.level < kFinest;
      if (!split) {
        cells_.push_back(cell);
        continue;
      }
      any = true;
      sum(cell, -1.0);
      for (const int child : {0, 1, 2, 3}) {
        add(cell.level + 1, 2 * cell.column + child % 2, 2 * cell.row + child / 2, &cell);
      }
    }
    return any;
  }

  const rays::Scene& scene_;
  const Lamp& lamp_;
  const Face& face_;
  Vec3 point_;
  rays::Mobilities among_;
  int slender_;
  std::vector<Cell> cells_;
  std::vector<std::uint16_t> raster_;  // indices of cells
  int finest_ = 0;
  double free_ = 0.0, seen_ = 0.0;
};

bool sees(const rays::Scene& scene, const Lamp& lamp, const Vec3& point, const Vec3& on_lamp,
          rays::Mobilities among) {
  if (lamp.type != Lamp::Type::kDirectional) return !scene.blocked(point, on_lamp, 1e-4, among);
  const Vec3 towards = -(lamp.pose.rotation * lamp.direction);
  return !scene.blocked(point, point + kSunlit * towards, 1e-4, among);
}

/// Whether parts of a flat lamp differ much in distance and direction.
bool is_close(const Lamp& lamp, const Vec3& point) {
  const double size =
      lamp.type == Lamp::Type::kRectangle ? std::max(lamp.width, lamp.height) : 2.0 * lamp.radius;
  return lamp.flat() && (lamp.pose.position - point).norm() < size;
}

/// Where a cosine-weighted direction meets the flat lamp; none if `kTries` directions miss it.
std::optional<Vec3> point_of_light(const Lamp& lamp, const Vec3& point, const Vec3& normal,
                                   std::size_t which) {
  const Axes axes = axes_of(lamp);
  const Eigen::Matrix3d frame = frame_about(normal);
  const Vec3 shines = lamp.pose.rotation * lamp.direction;
  const Vec3 middle = lamp.pose.position - point;
  const double ahead = middle.dot(shines);
  for (std::size_t k = 0; k < kTries; ++k) {
    const auto n = static_cast<double>(which * kTries + k);
    const double u = n * kFirstStep, v = n * kSecondStep;
    const Vec3 way = frame * cosine_direction(u - std::floor(u), v - std::floor(v));
    const double along = way.dot(shines);
    if (!(along < 0.0)) continue;
    const Vec3 off = ahead / along * way - middle;
    const double x = off.dot(axes.along), y = off.dot(axes.across);
    const bool meets = lamp.type == Lamp::Type::kRectangle
                           ? std::abs(x) < lamp.width / 2 && std::abs(y) < lamp.height / 2
                           : x * x + y * y < lamp.radius * lamp.radius;
    if (meets) return lamp.pose.position + off;
  }
  return std::nullopt;
}

}  // namespace

Vec3 lamp_point(const Lamp& lamp, std::size_t which) {
  if (!lamp.flat() && lamp.type != Lamp::Type::kTube) return lamp.pose.position;
  const auto [u, v] = square_points()[which % kLampPoints];
  const Axes axes = axes_of(lamp);
  if (lamp.type == Lamp::Type::kTube) {
    return lamp.pose.position + (u - 0.5) * lamp.length * axes.along;
  }
  if (lamp.type == Lamp::Type::kRectangle) {
    return lamp.pose.position + (u - 0.5) * lamp.width * axes.along +
           (v - 0.5) * lamp.height * axes.across;
  }
  const double out = lamp.radius * std::sqrt(u), angle = 2.0 * M_PI * v;
  return lamp.pose.position + out * (std::cos(angle) * axes.along + std::sin(angle) * axes.across);
}

double visible_share(const rays::Scene& scene, const Lamp& lamp, const Vec3& point,
                     const Vec3& normal, rays::Mobilities among) {
  if (!lamp.cast_shadows) return 1.0;
  const Face face(lamp, point, normal);
  if (face.is_point()) return sees(scene, lamp, point, lamp.pose.position, among) ? 1.0 : 0.0;
  Cells cells(scene, lamp, face, point, among);
  if (!cells.partly()) return cells.share();
  cells.refine(kLuxError / illuminance(lamp, point, normal));
  return cells.share();
}

bool sees_any(const rays::Scene& scene, const Lamp& lamp, const Vec3& point, const Vec3& normal,
              rays::Mobilities among) {
  if (!lamp.cast_shadows) return true;
  const Face face(lamp, point, normal);
  if (face.is_point()) return sees(scene, lamp, point, lamp.pose.position, among);
  return Cells(scene, lamp, face, point, among).share() > 0.0;
}

bool sees_one(const rays::Scene& scene, const Lamp& lamp, const Vec3& point, const Vec3& normal,
              std::size_t which, rays::Mobilities among) {
  if (!lamp.cast_shadows) return true;
  if (is_close(lamp, point)) {
    if (const std::optional<Vec3> on_lamp = point_of_light(lamp, point, normal, which)) {
      return sees(scene, lamp, point, *on_lamp, among);
    }
  }
  const bool globe = !lamp.flat() && lamp.type != Lamp::Type::kTube;
  const Vec3 on_lamp =
      globe ? Face(lamp, point, Vec3::Zero()).at(square_points()[which % kLampPoints])
            : lamp_point(lamp, which);
  return sees(scene, lamp, point, on_lamp, among);
}

}  // namespace angen::light
