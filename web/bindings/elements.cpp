/// Elements of scenes, hemicubes over them and rows of form factors for JavaScript; web/page/core.ts has the types.
#include <emscripten.h>
#include <emscripten/bind.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "radiosity/discretization/patch_points.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/scene/surface_names.h"
#include "raster/base/input_error.h"
#include "raster/interface/item_buffer_renderer.h"
#include "raster/interface/item_id.h"
#include "reference/rows/scene_rows.h"
#include "web/bindings/light.h"
#include "web/bindings/scenes.h"
#include "web/bindings/vectors.h"

namespace hemitex::web {
namespace {

using raster::InputError;

Value elementsInfo(const ElementsHandle& handle) {
  const radiosity::Discretization& discretization = *handle.discretization;
  Json surfaces = Json::array();
  for (std::size_t s = 0; s < discretization.grids.size(); ++s) {
    const radiosity::Grid& grid = discretization.grids[s];
    Json surface = describe(*handle.scene, handle.scene->surfaces[s]);
    surface["columns"] = grid.columns;
    surface["rows"] = grid.rows;
    surface["first_element"] = grid.firstElement;
    surface["element_count"] = grid.elementCount;
    surfaces.push_back(surface);
  }
  return toValue({{"elements", discretization.elements.size()}, {"surfaces", surfaces}});
}

Value geometryOf(const ElementsHandle& handle, unsigned number) {
  return guarded([&] {
    const radiosity::Surface& surface = itemOf(handle.scene->surfaces, number, "surface");
    const radiosity::Grid& grid = handle.discretization->grids[number];
    std::vector<float> positions, charts;
    for (const radiosity::Triangle& triangle : surface.triangles)
      for (std::size_t corner = 0; corner < 3; ++corner) {
        for (int axis = 0; axis < 3; ++axis) positions.push_back(static_cast<float>(triangle.position[corner][axis]));
        for (int axis = 0; axis < 2; ++axis) charts.push_back(static_cast<float>(triangle.chart[corner][axis]));
      }
    std::vector<std::uint32_t> elementOfTexel = grid.elementOfTexel;
    for (std::size_t t = 0; t < elementOfTexel.size(); ++t)
      if (!grid.covered[t]) elementOfTexel[t] = radiosity::noElement;
    Value result = Value::object();
    result.set("positions", toArray("Float32Array", positions));
    result.set("charts", toArray("Float32Array", charts));
    result.set("elementOfTexel", toArray("Uint32Array", elementOfTexel));
    return result;
  });
}

Value patchOfElement(const ElementsHandle& handle) {
  return toArray("Uint32Array", handle.discretization->patches.ofElement);
}

Value areasOf(const ElementsHandle& handle) {
  std::vector<double> areas;
  for (const radiosity::Element& element : handle.discretization->elements) areas.push_back(element.area);
  return toArray("Float64Array", areas);
}

Value idsOf(const ElementsHandle& handle, const Value& settings) {
  return guarded([&] {
    const radiosity::IdLayout layout = radiosity::layOut(*handle.discretization, idSettings(jsonOf(settings)));
    Json pages = Json::array();
    for (const radiosity::Page& page : layout.pages)
      pages.push_back({{"offset", page.offset}, {"columns", page.columns}, {"rows", page.rows}});
    return toValue({{"bits", raster::idBits(layout.format)}, {"index_bits", layout.indexBits}, {"pages", pages}});
  });
}

/// The surface of an element. Throws InputError if there is no such element.
std::uint32_t surfaceOf(const ElementsHandle& handle, std::uint32_t element) {
  return itemOf(handle.discretization->elements, element, "element").surface;
}

/// A renderer of the elements and the view from the centre of one of them.
struct ElementView {
  ElementView(const ElementsHandle& handle, std::uint32_t element, const Json& settings)
      : scene(*handle.scene),
        discretization(*handle.discretization),
        drawing(drawingSettings(settings)),
        layout(radiosity::layOut(discretization, idSettings(settings))),
        renderer(radiosity::sceneRenderer(scene, discretization, layout, drawing.elementsBy,
                                          [this](raster::DrawList drawn) {
                                            list = drawn;
                                            return radiosity::softwareRenderer(std::move(drawn));
                                          })),
        rows(scene, discretization, layout, *renderer, {.resolution = drawing.resolution}),
        view(rows.viewFrom({.surface = surfaceOf(handle, element),
                            .point = radiosity::elementCentre(scene, discretization, element)})) {}

  const radiosity::Scene& scene;
  const radiosity::Discretization& discretization;
  radiosity::DrawingSettings drawing;
  radiosity::IdLayout layout;
  raster::DrawList list;
  std::unique_ptr<raster::ItemBufferRenderer> renderer;
  radiosity::ProjectedFormFactors rows;
  radiosity::View view;
};

/// The element of each item ID; -1 for the background and -2 for backs.
std::vector<std::int32_t> elementsIn(const raster::ItemBuffer& buffer, const ElementView& from) {
  std::vector<std::int32_t> numbers;
  for (const raster::ItemId id : buffer.ids) {
    const auto element = radiosity::elementOf(from.discretization, from.layout, id);
    numbers.push_back(element                                    ? static_cast<std::int32_t>(*element)
                      : id == raster::backId(from.layout.format) ? -2
                                                                 : -1);
  }
  return numbers;
}

/// The form factors of all elements.
std::vector<double> dense(const radiosity::FormFactorRow& row, std::size_t elements) {
  std::vector<double> factors(elements);
  for (std::size_t k = 0; k < row.elements.size(); ++k) factors[row.elements[k]] = radiosity::formFactor(row.shares[k]);
  return factors;
}

Value hemicube(const ElementsHandle& handle, unsigned element, const Value& settings) {
  return guarded([&] {
    ElementView from(handle, element, jsonOf(settings));
    const auto buffers = raster::render(*from.renderer, from.view.faces, from.view.skipped);
    const radiosity::FormFactorRow row = from.rows.ofView(from.view);
    Value faces = Value::array();
    for (std::size_t f = 0; f < buffers.size(); ++f) {
      const raster::Scissor& scissor = from.view.faces[f].scissor;
      Value face = Value::object();
      face.set("width", scissor.width);
      face.set("height", scissor.height);
      face.set("elements", toArray("Int32Array", elementsIn(buffers[f], from)));
      face.set("weights", toArray("Float64Array", radiosity::deltaFormFactors(*from.view.projection, f)));
      faces.call<void>("push", face);
    }
    Value result = Value::object();
    result.set("faces", faces);
    result.set("formFactors", toArray("Float64Array", dense(row, from.discretization.elements.size())));
    result.set("background", radiosity::formFactor(row.background));
    result.set("backs", radiosity::formFactor(row.back));
    return result;
  });
}

/// The list without some triangles, whose numbers ascend.
raster::DrawList without(const raster::DrawList& list, const std::vector<std::uint32_t>& skipped) {
  raster::DrawList kept = list;
  kept.indices.clear();
  for (raster::Draw& draw : kept.draws) {
    const auto first = static_cast<std::uint32_t>(kept.indices.size());
    for (std::uint32_t i = draw.first; i < draw.first + draw.count; i += 3)
      if (!std::binary_search(skipped.begin(), skipped.end(), i / 3))
        kept.indices.insert(kept.indices.end(), list.indices.begin() + i, list.indices.begin() + i + 3);
    draw.first = first;
    draw.count = static_cast<std::uint32_t>(kept.indices.size()) - first;
  }
  return kept;
}

std::shared_ptr<VectorHandle> vectorOver(const ElementsHandle& handle, unsigned element, const Value& settings) {
  return guarded([&] {
    const ElementView from(handle, element, jsonOf(settings));
    reference::TestVector vector =
        reference::makeVector("hemicube", "", without(from.list, from.view.skipped), from.view.faces,
                              {"top", "side-right", "side-up", "side-left", "side-down"});
    vector.origin = from.scene.origin;
    return handleOf(std::move(vector));
  });
}

Value timeOfHemicube(const ElementsHandle& handle, unsigned element, const Value& settings, int repeats) {
  return guarded([&] {
    const ElementView from(handle, element, jsonOf(settings));
    std::vector<raster::ItemBuffer> buffers;
    double fastest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < std::max(1, repeats); ++k) {
      const double start = emscripten_get_now();
      raster::draw(*from.renderer, from.view.faces, from.view.skipped, buffers);
      fastest = std::min(fastest, emscripten_get_now() - start);
    }
    return toValue({{"milliseconds", fastest}, {"triangles", from.list.indices.size() / 3}});
  });
}

/// The source {"element": number} or {"surface": name}.
reference::Source sourceOf(const ElementsHandle& handle, const Json& source) {
  if (!source.contains("element"))
    return {radiosity::surfacesNamed(*handle.scene, source.at("surface").get<std::string>())};
  const auto element = source["element"].get<std::uint32_t>();
  return {{surfaceOf(handle, element)}, element};
}

reference::RayOptions rayOptions(const Json& settings) {
  reference::RayOptions rays;
  rays.samples = settings.value("samples", rays.samples);
  if (rays.samples < 64 || rays.samples > 1 << 28) throw InputError("the number of rays is not from 64 to 2^28");
  rays.seed = settings.value("seed", rays.seed);
  return rays;
}

reference::RowMethod methodOf(const ElementsHandle& handle, const reference::RowReceivers& receivers,
                              const Json& settings) {
  enum class Method { Hemicube, Rays, Analytic };
  const radiosity::Scene& scene = *handle.scene;
  const radiosity::Discretization& discretization = *handle.discretization;
  switch (
      valueNamed<Method>(settings.value("method", "hemicube"), "method",
                         {{"hemicube", Method::Hemicube}, {"rays", Method::Rays}, {"analytic", Method::Analytic}})) {
    case Method::Rays:
      return reference::rayMethod(scene, discretization, receivers, rayOptions(settings));
    case Method::Analytic:
      return reference::analyticMethod(scene, discretization, receivers);
    case Method::Hemicube:
      break;
  }
  return reference::drawnMethod(scene, discretization, receivers,
                                radiosity::layOut(discretization, idSettings(settings)), drawingSettings(settings));
}

Value rowOf(const ElementsHandle& handle, const Value& source, const Value& given) {
  return guarded([&] {
    const reference::RowReceivers receivers = reference::elementsAsReceivers(*handle.discretization);
    const reference::Source from = sourceOf(handle, jsonOf(source));
    const reference::RowMethod method = methodOf(handle, receivers, jsonOf(given));
    const double start = emscripten_get_now();
    reference::SparseRow row = method.row(from);
    const double milliseconds = emscripten_get_now() - start;
    const std::size_t count = receivers.area.size();
    const reference::OutsideShares outside = row.takeOutside(count);
    const auto spread = [&](const std::vector<double>& entries) {
      return toArray("Float64Array", row.spread(entries, count));
    };
    Value result = Value::object();
    result.set("formFactors", spread(row.value));
    result.set("standardErrors", row.error.empty() ? Value::null() : spread(row.error));
    result.set("background", outside.surroundings.value_or(0));
    result.set("backs", outside.backs.value_or(0));
    result.set("milliseconds", milliseconds);
    return result;
  });
}

}  // namespace

EMSCRIPTEN_BINDINGS(elements) {
  using namespace emscripten;
  class_<ElementsHandle>("Elements")
      .smart_ptr<std::shared_ptr<ElementsHandle>>("Elements")
      .function("info", &elementsInfo)
      .function("geometry", &geometryOf)
      .function("patchOfElement", &patchOfElement)
      .function("areas", &areasOf)
      .function("ids", &idsOf)
      .function("hemicube", &hemicube)
      .function("vector", &vectorOver)
      .function("timeOfHemicube", &timeOfHemicube)
      .function("row", &rowOf)
      .function("solve", &solve);
}

}  // namespace hemitex::web
