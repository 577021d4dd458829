#include "home/grid.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "py/bindings.h"

namespace angen::py {

namespace {

using Cells = pyb::array_t<std::int32_t, pyb::array::c_style | pyb::array::forcecast>;
using Three = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

Eigen::VectorXd cast_rays(const World& world, const Eigen::Ref<const Three>& origins,
                          const Eigen::Ref<const Three>& directions,
                          const std::variant<double, Eigen::VectorXd>& reach) {
  const auto* each = std::get_if<Eigen::VectorXd>(&reach);
  if (directions.rows() != origins.rows() || (each != nullptr && each->size() != origins.rows())) {
    throw Error("as many directions and reaches as origins are needed");
  }
  if (!origins.allFinite() || !directions.allFinite() ||
      (directions.rowwise().norm().array() == 0.0).any()) {
    throw Error("origins and directions are finite, and no direction is 0 0 0");
  }
  if (!(each != nullptr ? (each->array() >= 0.0).all() : std::get<double>(reach) >= 0.0)) {
    throw Error("a reach is 0 m or more");
  }
  std::vector<rays::Ray> rays;
  rays.reserve(static_cast<std::size_t>(origins.rows()));
  for (Eigen::Index i = 0; i < origins.rows(); ++i) {
    rays.push_back({origins.row(i).transpose(), directions.row(i).transpose().normalized(), 0.0,
                    each ? (*each)[i] : std::get<double>(reach)});
  }
  const std::vector<rays::Hit> hits = [&] {
    const Exclusive::Busy busy(world);
    const pyb::gil_scoped_release release;
    return world.cast(rays);
  }();
  Eigen::VectorXd ranges(origins.rows());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ranges[static_cast<Eigen::Index>(i)] = std::min(hits[i].range, rays[i].max);
  }
  return ranges;
}

Grid grid_of(const Cells& cells, const std::pair<double, double>& origin, double resolution,
             int floor, double height) {
  if (cells.ndim() != 2) throw Error("cells are rows and columns of numbers");
  if (!(resolution > 0.0)) throw Error("a resolution is greater than 0");
  Grid grid;
  grid.origin = {origin.first, origin.second};
  grid.side = resolution;
  grid.rows = static_cast<int>(cells.shape(0));
  grid.columns = static_cast<int>(cells.shape(1));
  grid.floor = floor;
  grid.height = height;
  grid.cells.assign(cells.data(), cells.data() + cells.size());
  return grid;
}

pyb::array cells_of(const pyb::object& self) {
  auto& grid = self.cast<Grid&>();
  return pyb::array_t<std::int32_t>({grid.rows, grid.columns}, grid.cells.data(), self);
}

std::pair<double, double> pair_of(const Point2& point) { return {point.x(), point.y()}; }

Polygon polygon_of(const std::vector<std::pair<double, double>>& corners) {
  Polygon polygon;
  for (const auto& [x, y] : corners) polygon.emplace_back(x, y);
  return polygon;
}

std::vector<std::pair<double, double>> corners_of(const Polygon& polygon) {
  std::vector<std::pair<double, double>> corners;
  for (const Point2& corner : polygon) corners.push_back(pair_of(corner));
  return corners;
}

Eigen::VectorXd middles(double origin, double side, int count) {
  Eigen::VectorXd all(count);
  for (int i = 0; i < count; ++i) all[i] = origin + side * (i + 0.5);
  return all;
}

pyb::object region(const Grid& grid, std::int32_t label, double tolerance, double least) {
  const std::optional<Region> found = region_of(grid, label, tolerance, least);
  if (!found) return pyb::none();
  pyb::list holes;
  for (const Polygon& hole : found->holes) holes.append(corners_of(hole));
  return pyb::make_tuple(corners_of(found->outline), holes);
}

void bind_cells(pyb::module_& module) {
  pyb::class_<Grid> grid(
      module, "Grid",
      "A floor in square cells, from above: `cells` (rows, columns) of numbers, row 0 with "
      "the lowest y; `origin` is x, y (m) of the outer corner of cell 0, 0.");
  grid.attr("WALL") = Grid::kWall;
  grid.attr("FREE") = Grid::kFree;
  grid.def(pyb::init(&grid_of), pyb::arg("cells"), pyb::arg("origin"), pyb::arg("resolution"),
           pyb::arg("floor") = 0, pyb::arg("height") = 0.0)
      .def_property_readonly("cells", &cells_of, "int32, to read and to write")
      .def_property_readonly("origin", [](const Grid& g) { return pair_of(g.origin); })
      .def_readonly("resolution", &Grid::side, "m, the side of a cell")
      .def_readonly("floor", &Grid::floor, "the number of its storey")
      .def_readonly("height", &Grid::height, "z of that floor, m")
      .def_property_readonly(
          "x", [](const Grid& g) { return middles(g.origin.x(), g.side, g.columns); },
          "(columns,): of the middles of cells, m")
      .def_property_readonly(
          "y", [](const Grid& g) { return middles(g.origin.y(), g.side, g.rows); },
          "(rows,): of the middles of cells, m")
      .def_property_readonly(
          "extent",
          [](const Grid& g) {
            const Point2 far = g.origin + g.side * Point2(g.columns, g.rows);
            return pyb::make_tuple(g.origin.x(), far.x(), g.origin.y(), far.y());
          },
          "West, east, south and north edge, m, as imshow of matplotlib takes them.")
      .def(
          "cell",
          [](const Grid& g, double x, double y) {
            if (!std::isfinite(x) || !std::isfinite(y)) throw Error("x and y are finite, in m");
            const auto [column, row] = g.cell({x, y});
            return std::pair(row, column);
          },
          pyb::arg("x"), pyb::arg("y"), "(row, column) of a point (m); may be beyond the raster.")
      .def(
          "point",
          [](const Grid& g, int row, int column) { return pair_of(g.middle(column, row)); },
          pyb::arg("row"), pyb::arg("column"), "x, y (m) of a cell's middle.")
      .def(
          "with_cells",
          [](const Grid& g, const Cells& cells) {
            return grid_of(cells, pair_of(g.origin), g.side, g.floor, g.height);
          },
          pyb::arg("cells"), "One of other cells at the same place.")
      .def(
          "fill",
          [](Grid& g, const std::vector<std::pair<double, double>>& polygon, std::int32_t value) {
            g.fill(polygon_of(polygon), value);
          },
          pyb::arg("polygon"), pyb::arg("value"),
          "Sets the cells whose middles a polygon contains.")
      .def("number_parts", &number_parts,
           "Numbers the connected parts of the cells that are FREE from 0; their sizes in cells.")
      .def("region", &region, pyb::arg("label"), pyb::arg("tolerance"), pyb::arg("least"),
           "The outline of a label's cells, and its holes of more than `least` m2, as corners (m); "
           "corners off a straight line by less than `tolerance` (m) are left out.")
      .def(pyb::pickle(
          [](const pyb::object& self) {
            const auto& g = self.cast<const Grid&>();
            return pyb::make_tuple(cells_of(self), pair_of(g.origin), g.side, g.floor, g.height);
          },
          [](const pyb::tuple& state) {
            return grid_of(state[0].cast<Cells>(), state[1].cast<std::pair<double, double>>(),
                           state[2].cast<double>(), state[3].cast<int>(), state[4].cast<double>());
          }));
}

}  // namespace

void bind_grid(pyb::module_& module, pyb::class_<World>& world) {
  bind_cells(module);
  world.def(
      "cast", &cast_rays, pyb::arg("origins"), pyb::arg("directions"), pyb::arg("reach"),
      "Ranges (n,) in m of rays from origins (n, 3) along unit directions (n, 3), in the world, "
      "against the shapes as they are now; `reach` (m, a number or (n,)) of rays that hit "
      "nothing within it.");
  module.def(
      "storey_at",
      [](const std::vector<std::pair<int, double>>& described, const pyb::array_t<double>& z) {
        std::vector<Storey> storeys;
        for (const auto& [number, elevation] : described) {
          storeys.push_back({number, "", elevation, 0.0});
        }
        return pyb::vectorize([&](double at) { return floor_at(storeys, at); })(z);
      },
      pyb::arg("storeys"), pyb::arg("z"),
      "Of storeys (number, elevation), from the lowest up, the number of the one at a height z: "
      "the highest whose floor is at most 0.5 m above it, or else the lowest; 0 without storeys. z "
      "may be an array.");
}

}  // namespace angen::py
