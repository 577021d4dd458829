#pragma once

#include <string>
#include <vector>

#include "core/pose.h"

namespace angen::sensors {

/// A span of azimuth (to the left) and one of elevation (upwards) about the detector's x axis, rad.
struct Window {
  double right = 0.0;
  double left = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// The zones of a detector's two elements, through the facets of its Fresnel lens: rows of zones of
/// alternating sign from right to left. Elements and the gaps between them are equally wide.
class FresnelLens {
  struct Zones {
    Window window;
    double width;              // rad, of a pair
    std::vector<double> sign;  // sign of each zone from right to left; 0 = taped over
  };

 public:
  /// `pairs` zones of each sign side by side in `window`.
  struct Row {
    int pairs = 1;
    Window window;
  };

  FresnelLens() = default;
  explicit FresnelLens(const std::vector<Row>& rows);

  /// No zone whose middle lies in `window` sees anything any more.
  void tape(const Window& window);

  /// Its zones at one elevation; valid as long as the lens.
  class Line {
   public:
    /// -1 to 1: the share of radiation from there on the positive element, less that on the
    /// negative one. The edges of a zone are soft.
    double sensitivity(double azimuth) const;
    bool empty() const { return parts_.empty(); }

   private:
    friend class FresnelLens;
    struct Part {
      const Zones* row;
      double up;  // share of the row's sensitivity at this elevation
    };
    std::vector<Part> parts_;
  };
  void find_line(double elevation, Line& line) const;
  double sensitivity(double azimuth, double elevation) const {
    Line line;
    find_line(elevation, line);
    return line.sensitivity(azimuth);
  }

  /// Unit vectors into the zones that see something: nine evenly over each.
  std::vector<Vec3> directions() const;

  /// rad: of the narrowest zone, and of the lowest row.
  double narrowest() const;
  double lowest() const;

  /// All that the zones see, taped or not.
  const Window& window() const { return window_; }

 private:
  std::vector<Zones> rows_;
  Window window_;
};

/// The lenses of lenses.txt, which the build puts into `kLensTable`.
extern const char* const kLensTable;
std::vector<std::string> lens_names();
std::vector<FresnelLens::Row> lens_rows(const std::string& name);

}  // namespace angen::sensors
