// The table of the parameters of the geometry: [sample] and what it holds. Defaults are those of scene.h.
#include "generator/sample/scene_ranges.h"
#include "generator/sample/scene_rows.h"

namespace lamella {

template <>
const std::vector<Row<SampleScene>>& rows() {
  using S = SampleScene;
  static const std::vector<Row<S>> list{
      {.key = "kind",
       .member = &S::kind,
       .sentence = "What is made: a tissue of Laguerre-Voronoi cells, rings on the disks of a packing, a regular "
                   "honeycomb, a brick "
                   "wall, a tissue of given polygons, or of a picture, or only the shapes listed.",
       .choices = {"tissue", "rings", "honeycomb", "bricks", "polygons", "image", "shapes"},
       .required = true},
      {.key = "width",
       .member = &S::width,
       .unit = "m",
       .range = kPositive,
       .sentence = "Of the box.",
       .fallback = "from the sizes, or from the shapes and polygons"},
      {.key = "height",
       .member = &S::height,
       .unit = "m",
       .range = kPositive,
       .sentence = "Of the box.",
       .fallback = "from the sizes, or from the shapes and polygons"},
      {.key = "ring_nodes",
       .member = &S::ring_nodes,
       .range = at_least(3),
       .sentence = "rings: mass points of each ring."},
      {.key = "columns",
       .member = &S::columns,
       .range = at_least(1),
       .sentence = "honeycomb, bricks: cells along x.",
       .fallback = "required there"},
      {.key = "rows",
       .member = &S::rows,
       .range = at_least(1),
       .sentence = "honeycomb, bricks: cells along y.",
       .fallback = "required there"},
      {.key = "side",
       .member = &S::side,
       .unit = "m",
       .range = kPositive,
       .sentence = "honeycomb: side of the hexagons.",
       .fallback = "required for a honeycomb"},
      {.key = "orientation",
       .member = &S::orientation,
       .sentence = "honeycomb: pointy has walls along y, flat has walls along x.",
       .choices = {"pointy", "flat"}},
      {.key = "brick",
       .member = &S::brick,
       .unit = "m",
       .sentence = "bricks: width and height of one.",
       .fallback = "required for bricks"},
      {.key = "shift",
       .member = &S::shift,
       .unit = "1",
       .range = {0, 1, false, true},
       .sentence = "bricks: of every second row, in widths of a brick."},
      {.key = "periodic",
       .member = &S::periodic,
       .sentence = "tissue, honeycomb, bricks: along which directions the sample repeats: it goes on beyond these "
                   "sides of its box, which are "
                   "none.",
       .choices = {"none", "x", "y", "xy"}},
      {.key = "file",
       .member = &S::file,
       .sentence = "polygons: text file with `x y cell` a line, consecutive points of a cell; or *.tess, *.off.",
       .fallback = "required for polygons"},
      {.key = "outlines",
       .member = &S::outlines,
       .sentence = "polygons: walls coincide (shared), or each cell has its own centre line (separate).",
       .choices = {"shared", "separate"}},
      {.key = "facing_tolerance",
       .member = &S::facing_tolerance,
       .unit = "m",
       .range = kPositive,
       .sentence = "polygons, separate: largest distance of centre lines that are linked.",
       .fallback = "1.1 times the sum of the two radii"},
      {.key = "scale",
       .member = &S::scale,
       .unit = "m",
       .range = kPositive,
       .sentence = "polygons: length of one unit of the file."},
  };
  return list;
}

template <>
const std::vector<Row<SizesScene>>& rows() {
  using S = SizesScene;
  static const std::vector<Row<S>> list{
      {.key = "distribution",
       .member = &S::distribution,
       .sentence = "Of the radii of the disks.",
       .choices = {"uniform", "normal", "lognormal", "gamma", "weibull", "bidisperse", "table", "mixture", "file"}},
      {.key = "mean",
       .member = &S::mean,
       .unit = "m",
       .range = kPositive,
       .sentence = "Mean radius; only ratios matter when the box is given.",
       .fallback = "required unless the box is given"},
      {.key = "cv", .member = &S::cv, .unit = "1", .range = between(0, 1), .sentence = "Standard deviation over mean."},
      {.key = "ratio",
       .member = &S::ratio,
       .unit = "1",
       .range = between(1, 100),
       .sentence = "bidisperse: large over small radius."},
      {.key = "share",
       .member = &S::share,
       .unit = "1",
       .range = kFraction,
       .sentence = "bidisperse: share of large disks by number."},
      {.key = "table",
       .member = &S::table,
       .unit = "m",
       .sentence = "table: [[radius, density of probability], ...], linear between; any scale of the densities.",
       .fallback = "required for table",
       .unit_of_second = "1"},
      {.key = "file", .member = &S::file, .sentence = "file: one radius [m] a line.", .fallback = "required for file"},
  };
  return list;
}

template <>
const std::vector<Row<PackingScene>>& rows() {
  using S = PackingScene;
  static const std::vector<Row<S>> list{
      {.key = "count",
       .member = &S::count,
       .range = between(1, 1e7),
       .sentence = "Number of disks, one for each cell."},
      {.key = "fraction",
       .member = &S::fraction,
       .unit = "1",
       .range = {0.01, 0.9},
       .sentence = "Area of the disks over area of the box."},
      {.key = "boundary",
       .member = &S::boundary,
       .sentence = "Disks lie between walls, or repeat beyond the box.",
       .choices = {"walls", "periodic", "periodic_x", "periodic_y"}},
      {.key = "jammed", .member = &S::jammed, .sentence = "Compress until jammed, whatever the fraction."},
      {.key = "file",
       .member = &S::file,
       .sentence = "CSV `x,y,r` or `x,y,r,target_area` of a packing from elsewhere, or *.tess, whose seeds it is.",
       .fallback = "a packing is made"},
      {.key = "duplicates",
       .member = &S::duplicates,
       .sentence = "What to do with disks of one centre.",
       .choices = {"error", "keep_first"}},
  };
  return list;
}

template <>
const std::vector<Row<WallsScene>>& rows() {
  using S = WallsScene;
  static const std::vector<Row<S>> list{
      {.key = "spacing",
       .member = &S::spacing,
       .unit = "m",
       .range = kPositive,
       .sentence = "Asked distance of mass points along a wall.",
       .fallback = "this or segments is required for a tissue, honeycomb or polygons"},
      {.key = "segments",
       .member = &S::segments,
       .range = between(1, 10000),
       .sentence = "Segments on a wall of mean length, instead of spacing.",
       .fallback = "this or spacing is required for a tissue, honeycomb or polygons"},
      {.key = "weld",
       .member = &S::weld,
       .unit = "1",
       .range = between(0, 0.5),
       .sentence = "Edges shorter than this fraction of the mean edge are welded to a point."},
      {.key = "links",
       .member = &S::links,
       .sentence = "Which facing points are linked: all, those at the ends of walls, or none.",
       .choices = {"all", "ends", "none"}},
      {.key = "gap",
       .member = &S::gap,
       .unit = "m",
       .range = kNotNegative,
       .sentence = "Distance of facing outlines: facing points lie at twice the radius plus this."},
      {.key = "missing",
       .member = &S::missing,
       .unit = "1",
       .range = between(0, 1),
       .sentence = "Share of links that are absent from the start, taken at random by the seed."},
  };
  return list;
}

template <>
const std::vector<Row<NotchScene>>& rows() {
  using S = NotchScene;
  static const std::vector<Row<S>> list{
      {.key = "line",
       .member = &S::line,
       .unit = "m",
       .sentence = "Polyline [[x, y], ...]: links that it crosses are absent.",
       .fallback = "none"},
      {.key = "polygon",
       .member = &S::polygon,
       .unit = "m",
       .sentence = "Polygon [[x, y], ...]: cells whose centre lies inside are absent.",
       .fallback = "none"},
  };
  return list;
}

template <>
const std::vector<Row<ShapeScene>>& rows() {
  using S = ShapeScene;
  static const std::vector<Row<S>> list{
      {.key = "kind",
       .member = &S::kind,
       .sentence = "chain and plate: open, from `from` to `to`; box: open, holds things; ring; polygon.",
       .choices = {"chain", "plate", "box", "ring", "polygon"},
       .required = true},
      {.key = "group", .member = &S::group, .sentence = "Group whose parameters it takes."},
      {.key = "from",
       .member = &S::from,
       .unit = "m",
       .sentence = "chain, plate: first end; box: a corner.",
       .fallback = "required there"},
      {.key = "to",
       .member = &S::to,
       .unit = "m",
       .sentence = "chain, plate: last end; box: opposite corner.",
       .fallback = "required there"},
      {.key = "centre", .member = &S::centre, .unit = "m", .sentence = "ring: centre."},
      {.key = "size",
       .member = &S::size,
       .unit = "m",
       .range = kPositive,
       .sentence = "ring: radius of its vertices.",
       .fallback = "required for a ring"},
      {.key = "segments",
       .member = &S::segments,
       .range = between(1, 1e6),
       .sentence = "Of a chain, plate, ring, of each side of a box or polygon.",
       .fallback = "required but for polygons (1)"},
      {.key = "rotation", .member = &S::rotation, .unit = "rad", .sentence = "ring: angle of its first vertex."},
      {.key = "points",
       .member = &S::points,
       .unit = "m",
       .sentence = "polygon: [[x, y], ...], the first not repeated.",
       .fallback = "required for a polygon"},
      {.key = "open", .member = &S::open, .sentence = "polygon: an open chain, not a shell."},
      {.key = "clamp",
       .member = &S::clamp,
       .sentence = "chain: a ghost segment beyond an end, which makes it a clamp when held.",
       .choices = {"none", "start", "end", "both"}},
      {.key = "clamp_hinge",
       .member = &S::clamp_hinge,
       .sentence = "chain: half a hinge at the clamp (second order), or a full one (first order, for comparison).",
       .choices = {"half", "full"}},
  };
  return list;
}

template <>
const std::vector<Row<MixtureScene>>& rows() {
  using S = MixtureScene;
  static const std::vector<Row<S>> list{
      {.key = "distribution",
       .member = &S::distribution,
       .sentence = "Of the radii of this kind.",
       .choices = {"uniform", "normal", "lognormal", "gamma", "weibull"}},
      {.key = "mean",
       .member = &S::mean,
       .unit = "m",
       .range = kPositive,
       .sentence = "Mean radius; only ratios matter when the box is given.",
       .required = true},
      {.key = "cv", .member = &S::cv, .unit = "1", .range = between(0, 1), .sentence = "Standard deviation over mean."},
      {.key = "share",
       .member = &S::share,
       .unit = "1",
       .range = kPositiveFraction,
       .sentence = "Of all disks, by number.",
       .fallback = "this or area_share is required"},
      {.key = "area_share",
       .member = &S::area_share,
       .unit = "1",
       .range = kPositiveFraction,
       .sentence = "Of the area of all disks, instead of share; of the cells exactly with [sample.areas].",
       .fallback = "this or share is required"},
      {.key = "group", .member = &S::group, .sentence = "Group whose parameters its cells take."},
  };
  return list;
}

template <>
const std::vector<Row<DomainScene>>& rows() {
  using S = DomainScene;
  static const std::vector<Row<S>> list{
      {.key = "kind",
       .member = &S::kind,
       .sentence = "Shape of what the tissue fills.",
       .choices = {"disk", "ring", "polygon"},
       .required = true},
      {.key = "radius",
       .member = &S::radius,
       .unit = "m",
       .range = kPositive,
       .sentence = "disk, ring: outer radius; the centre is the origin.",
       .fallback = "required there"},
      {.key = "inner_radius",
       .member = &S::inner_radius,
       .unit = "m",
       .range = kPositive,
       .sentence = "ring: inner radius.",
       .fallback = "required for a ring"},
      {.key = "points",
       .member = &S::points,
       .unit = "m",
       .sentence = "polygon: [[x, y], ...], the first not repeated; it may be concave.",
       .fallback = "required for a polygon"},
      {.key = "sides",
       .member = &S::sides,
       .range = between(8, 10000),
       .sentence = "disk, ring, circular holes: sides of the polygon of equal area that stands for a circle."},
  };
  return list;
}

template <>
const std::vector<Row<HoleScene>>& rows() {
  using S = HoleScene;
  static const std::vector<Row<S>> list{
      {.key = "points",
       .member = &S::points,
       .unit = "m",
       .sentence = "Polygon [[x, y], ...].",
       .fallback = "this, or centre and radius"},
      {.key = "centre",
       .member = &S::centre,
       .unit = "m",
       .sentence = "Of a circular hole.",
       .fallback = "required for a circular hole"},
      {.key = "radius",
       .member = &S::radius,
       .unit = "m",
       .range = kPositive,
       .sentence = "Of a circular hole.",
       .fallback = "none"},
  };
  return list;
}

template <>
const std::vector<Row<AreasScene>>& rows() {
  using S = AreasScene;
  static const std::vector<Row<S>> list{
      {.key = "of",
       .member = &S::of,
       .sentence = "What has the prescribed share of the area: the cell's tile, or the inside of its wall: what the "
                   "inset by radius "
                   "and half the gap leaves of the tile.",
       .choices = {"tile", "inset"}},
      {.key = "sites",
       .member = &S::sites,
       .sentence = "Where cells begin: at the disks of a packing, or at random.",
       .choices = {"packing", "random"}},
      {.key = "sweeps",
       .member = &S::sweeps,
       .range = between(0, 1000),
       .sentence = "Of Lloyd's: every site moves to the centre of its tile, areas stay. More: rounder cells, fewer "
                   "short walls."},
      {.key = "tolerance",
       .member = &S::tolerance,
       .unit = "1",
       .range = between(1e-12, 0.1),
       .sentence = "Largest relative error of an area."},
  };
  return list;
}

template <>
const std::vector<Row<LayerScene>>& rows() {
  using S = LayerScene;
  static const std::vector<Row<S>> list{
      {.key = "along",
       .member = &S::along,
       .sentence = "What from and to measure: a coordinate, or the distance from the middle of the box.",
       .choices = {"x", "y", "radius"}},
      {.key = "from", .member = &S::from, .unit = "m", .sentence = "Where it begins."},
      {.key = "to",
       .member = &S::to,
       .unit = "m",
       .sentence = "Where it ends.",
       .fallback = "this or polygon is required"},
      {.key = "polygon", .member = &S::polygon, .unit = "m", .sentence = "Instead: [[x, y], ...].", .fallback = "none"},
      {.key = "size",
       .member = &S::size,
       .unit = "1",
       .range = between(0.05, 20),
       .sentence = "Factor on the radii there."},
      {.key = "group", .member = &S::group, .sentence = "Group whose parameters its cells take."},
  };
  return list;
}

template <>
const std::vector<Row<GradientScene>>& rows() {
  using S = GradientScene;
  static const std::vector<Row<S>> list{
      {.key = "along",
       .member = &S::along,
       .sentence = "What positions are: a coordinate, or the distance from the middle of the box.",
       .choices = {"x", "y", "radius"}},
      {.key = "size",
       .member = &S::size,
       .unit = "m",
       .sentence = "[[position, factor on the radii], ...], linear between, constant beyond.",
       .fallback = "1",
       .unit_of_second = "1"},
      {.key = "thickness",
       .member = &S::thickness,
       .unit = "m",
       .sentence = "[[position, factor on thickness and radius of the walls], ...]",
       .fallback = "1",
       .unit_of_second = "1"},
      {.key = "strength",
       .member = &S::strength,
       .unit = "m",
       .sentence = "[[position, factor on the strengths of the links], ...]",
       .fallback = "1",
       .unit_of_second = "1"},
  };
  return list;
}

template <>
const std::vector<Row<StretchScene>>& rows() {
  using S = StretchScene;
  static const std::vector<Row<S>> list{
      {.key = "ratio",
       .member = &S::ratio,
       .unit = "1",
       .range = between(1, 20),
       .sentence = "Length over width of a cell that would be round.",
       .required = true},
      {.key = "angle",
       .member = &S::angle,
       .unit = "rad",
       .sentence = "Of the long way, from the x axis; 0 or 90 deg where the sample repeats."},
  };
  return list;
}

template <>
const std::vector<Row<ImageScene>>& rows() {
  using S = ImageScene;
  static const std::vector<Row<S>> list{
      {.key = "file",
       .member = &S::file,
       .sentence = "PGM, PNG or TIFF: one channel of 8, 16 or 32 bits.",
       .required = true},
      {.key = "kind",
       .member = &S::kind,
       .sentence = "labels: a pixel holds the number of its cell; grey: a micrograph, cells are found by threshold and "
                   "watershed.",
       .choices = {"labels", "grey"}},
      {.key = "pixel",
       .member = &S::pixel,
       .unit = "m",
       .range = kPositive,
       .sentence = "Side of a pixel.",
       .required = true},
      {.key = "cells",
       .member = &S::cells,
       .sentence = "outlines: cells as they are; laguerre: the Laguerre tessellation closest to them.",
       .choices = {"outlines", "laguerre"}},
      {.key = "background",
       .member = &S::background,
       .range = kNotNegative,
       .sentence = "labels: number of what is no cell; where no square of 4 pixels a side fits into it, it goes to the "
                   "nearest cells."},
      {.key = "walls",
       .member = &S::walls,
       .sentence = "grey: whether walls are darker or brighter than cells.",
       .choices = {"dark", "bright"}},
      {.key = "threshold",
       .member = &S::threshold,
       .unit = "1",
       .range = kInsideFraction,
       .sentence = "grey: between walls and cells, 1 is white.",
       .fallback = "Otsu's"},
      {.key = "smoothing",
       .member = &S::smoothing,
       .unit = "1",
       .range = between(0, 100),
       .sentence = "grey: standard deviation of the blur, in pixels."},
      {.key = "least_area",
       .member = &S::least_area,
       .range = at_least(1),
       .sentence = "Smaller cells are joined to the neighbour with the longest common wall, in pixels."},
      {.key = "simplify",
       .member = &S::simplify,
       .unit = "1",
       .range = between(0, 100),
       .sentence = "outlines: largest distance of a wall from the boundary of its pixels, in pixels."},
  };
  return list;
}

}  // namespace lamella
