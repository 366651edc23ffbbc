/// Test vectors, verdicts, diagnoses and calibration for JavaScript; web/page/core.ts has the types.
#include "web/bindings/vectors.h"

#include <emscripten/bind.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/conformance/calibration/calibration.h"
#include "reference/conformance/calibration/device_class.h"
#include "reference/conformance/diagnosis/fault.h"
#include "reference/conformance/diagnosis/verdict_report.h"
#include "reference/conformance/records/conformance_record.h"
#include "reference/conformance/scenes/scene_vectors.h"
#include "reference/conformance/verdict/explanation.h"
#include "reference/conformance/verdict/reduction.h"
#include "web/bindings/folder.h"
#include "web/bindings/values.h"

namespace hemitex::web {
namespace {

using raster::InputError;
using reference::TestVector;

reference::DeviceProfile profileOf(const Value& profile) { return reference::parseProfile(jsonOf(profile).dump()); }

Value listOf(std::vector<TestVector> vectors) {
  Value list = Value::array();
  for (TestVector& vector : vectors) list.call<void>("push", Value(handleOf(std::move(vector))));
  return list;
}

/// A typed array of the numbers of a file.
template <typename Number>
Value arrayOf(const char* type, const std::filesystem::path& file) {
  const std::string bytes = raster::readFile(file);
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return toArray(type, numbers);
}

const reference::VectorFace& faceNamed(const TestVector& vector, const std::string& name) {
  for (const reference::VectorFace& face : vector.faces)
    if (face.name == name) return face;
  throw InputError("the vector has no face `" + name + "`");
}

/// A report on a vector, which it keeps.
struct ReportHandle {
  std::shared_ptr<const TestVector> vector;
  reference::Report report;

  Value json() const { return toValue(reference::toJson(report)); }
  std::string findings() const { return reference::toText(report.findings); }
  Value pixels() const {
    Value list = Value::array();
    for (const reference::FaceVerdict& face : report.verdict.faces) {
      std::vector<std::uint8_t> verdicts;
      for (const reference::PixelVerdict verdict : face.pixels) verdicts.push_back(static_cast<std::uint8_t>(verdict));
      list.call<void>("push", toArray("Uint8Array", verdicts));
    }
    return list;
  }
  Value expected() const {
    std::vector<raster::ItemBuffer> buffers;
    for (const reference::FaceVerdict& face : report.verdict.faces) buffers.push_back(face.expected);
    return toArrays(buffers);
  }
};

std::vector<std::shared_ptr<ReportHandle>> handlesOf(const Value& reports) {
  auto handles = emscripten::vecFromJSArray<std::shared_ptr<ReportHandle>>(reports);
  if (std::find(handles.begin(), handles.end(), nullptr) != handles.end()) throw InputError("a report is null");
  return handles;
}

std::shared_ptr<ReportHandle> judge(const VectorHandle& handle, const Value& found, const Value& profile) {
  return guarded([&] {
    const auto buffers = buffersOf(found, reference::facesOf(*handle.vector));
    return std::make_shared<ReportHandle>(
        ReportHandle{handle.vector, reference::reportOn(*handle.vector, buffers, profileOf(profile))});
  });
}

std::shared_ptr<VectorHandle> minimize(const VectorHandle& handle, const Value& found, const Value& profile) {
  return guarded([&] {
    const auto buffers = buffersOf(found, reference::facesOf(*handle.vector));
    const reference::DeviceProfile allowed = profileOf(profile);
    const reference::Report report = reference::reportOn(*handle.vector, buffers, allowed);
    if (report.errors.empty()) throw InputError("the item buffers have no errors");
    return handleOf(reference::minimize(*handle.vector, report.verdict, allowed).vector);
  });
}

std::shared_ptr<VectorHandle> reduce(const VectorHandle& handle, const Value& fails, int maxRuns) {
  return guarded([&] {
    const auto stillFails = [&](const TestVector& vector) { return fails(Value(handleOf(vector))).as<bool>(); };
    return handleOf(reference::reduce(*handle.vector, stillFails, static_cast<std::size_t>(maxRuns)));
  });
}

Value faultsOf(const VectorHandle& handle) {
  return guarded([&] {
    Json list = Json::array();
    for (const reference::Fault& fault : reference::knownFaults(*handle.vector)) {
      Json variants = Json::array();
      for (const reference::Variant& variant : fault.variants) variants.push_back(variant.name);
      list.push_back({{"name", fault.name}, {"advice", fault.advice}, {"variants", variants}});
    }
    return toValue(list);
  });
}

Value drawFault(const VectorHandle& handle, unsigned fault, unsigned variant) {
  return guarded([&] {
    const auto faults = reference::knownFaults(*handle.vector);
    const reference::PlacedVector placed = reference::placeVector(*handle.vector);
    std::vector<raster::ItemBuffer> faces;
    // Each face comes in parts, some rows at a time.
    std::vector<raster::ItemId> ids;
    const auto& device = itemOf(itemOf(faults, fault, "fault").variants, variant, "variant").device;
    reference::drawOn(device, placed, [&](const raster::ItemBuffer& rows) {
      ids.insert(ids.end(), rows.ids.begin(), rows.ids.end());
      const raster::Scissor& scissor = placed.faces[faces.size()].scissor;
      if (ids.size() == static_cast<std::size_t>(scissor.width) * static_cast<std::size_t>(scissor.height)) {
        faces.push_back({scissor.width, scissor.height, std::move(ids)});
        ids.clear();
      }
      return true;
    });
    return toArrays(faces);
  });
}

/// The probes of calibration.
struct ProbesHandle {
  std::shared_ptr<const reference::ProbingSet> probes =
      std::make_shared<const reference::ProbingSet>(reference::makeProbes());

  Value vectors() const { return listOf(reference::vectorsOf(*probes)); }
  Value calibrate(const Value& answers) const {
    return guarded([&] {
      const auto lists = emscripten::vecFromJSArray<Value>(answers);
      const std::vector<TestVector> vectors = reference::vectorsOf(*probes);
      if (lists.size() != vectors.size()) throw InputError("there is not one answer per probe vector");
      std::vector<raster::ItemBuffer> buffers;
      for (std::size_t v = 0; v < vectors.size(); ++v)
        buffers.push_back(buffersOf(lists[v], reference::facesOf(vectors[v])).front());
      const reference::Calibration calibration = reference::calibrate(*probes, buffers);
      return toValue({{"profile", reference::toJson(calibration.profile)}, {"faults", calibration.faults}});
    });
  }
};

std::shared_ptr<VectorHandle> readVector(const Value& files) {
  return guarded([&] {
    const Folder folder(files);
    return handleOf(reference::readVector(folder.path()));
  });
}

Value verdictNames() {
  Json names = Json::array();
  for (const auto& [verdict, name] : reference::pixelVerdictNames) names.push_back(name);
  return toValue(names);
}

std::string deviceClass(const Value& reports) {
  return guarded([&]() -> std::string {
    std::vector<reference::JudgedVector> judged;
    for (const auto& handle : handlesOf(reports)) judged.push_back({handle->vector.get(), &handle->report.verdict});
    const auto guess = reference::guessDeviceClass(judged);
    return guess ? reference::toText(*guess) : "";
  });
}

std::string commonFault(const Value& reports) {
  return guarded([&]() -> std::string {
    std::vector<reference::Report> copies;
    for (const auto& handle : handlesOf(reports)) copies.push_back(handle->report);
    const auto common = reference::commonFault(copies);
    return common ? reference::toText(*common) : "";
  });
}

/// The vectors are those of the reports, whose files a record names by their hashes.
std::string record(const std::string& device, const std::string& driver, const Value& profile, const Value& reports) {
  return guarded([&] {
    reference::ConformanceRecord record{
        .device = device, .driver = driver, .profile = profileOf(profile), .vectors = {}};
    for (const auto& handle : handlesOf(reports)) {
      const Folder folder(handle->vector->name);
      reference::writeVector(folder.path(), *handle->vector, reference::render(*handle->vector));
      record.vectors.push_back(reference::recordOf(handle->report, folder.path()));
    }
    std::sort(record.vectors.begin(), record.vectors.end(),
              [](const auto& a, const auto& b) { return a.name < b.name; });
    return reference::toJson(record);
  });
}

}  // namespace

Value VectorHandle::json() const {
  return guarded([&] {
    const Folder folder;
    reference::writeVector(folder.path(), *vector, {});
    return toValue(Json::parse(raster::readFile(folder.path() / "vector.json")));
  });
}

Value VectorHandle::arrays() const {
  return guarded([&] {
    const Folder folder;
    reference::writeVector(folder.path(), *vector, {});
    const Json json = Json::parse(raster::readFile(folder.path() / "vector.json"));
    Value maps = Value::object(), arrays = Value::object();
    for (const Json& draw : json.at("draws"))
      if (const auto map = draw.find("index_map"); map != draw.end() && map->is_string())
        maps.set(map->get<std::string>(),
                 arrayOf<std::uint32_t>("Uint32Array", folder.path() / map->get<std::string>()));
    const auto file = [&](const char* key) { return folder.path() / json.at(key).get<std::string>(); };
    arrays.set("positions", arrayOf<float>("Float32Array", file("positions")));
    arrays.set("texcoords", arrayOf<float>("Float32Array", file("texcoords")));
    arrays.set("indices", arrayOf<std::uint32_t>("Uint32Array", file("indices")));
    arrays.set("maps", maps);
    return arrays;
  });
}

Value VectorHandle::render() const {
  return guarded([&] { return toArrays(reference::render(*vector)); });
}

Value VectorHandle::explain(const std::string& face, int column, int row) const {
  return guarded([&] { return toValue(reference::explanation(*vector, faceNamed(*vector, face), column, row)); });
}

EMSCRIPTEN_BINDINGS(vectors) {
  using namespace emscripten;
  class_<ReportHandle>("Report")
      .smart_ptr<std::shared_ptr<ReportHandle>>("Report")
      .function("json", &ReportHandle::json)
      .function("findings", &ReportHandle::findings)
      .function("pixels", &ReportHandle::pixels)
      .function("expected", &ReportHandle::expected);
  class_<VectorHandle>("Vector")
      .smart_ptr<std::shared_ptr<VectorHandle>>("Vector")
      .function("name", &VectorHandle::name)
      .function("catches", &VectorHandle::catches)
      .function("json", &VectorHandle::json)
      .function("arrays", &VectorHandle::arrays)
      .function("render", &VectorHandle::render)
      .function("explain", &VectorHandle::explain)
      .function("judge", &judge)
      .function("minimize", &minimize)
      .function("reduce", &reduce)
      .function("faults", &faultsOf)
      .function("drawFault", &drawFault);
  class_<ProbesHandle>("Probes")
      .smart_ptr<std::shared_ptr<ProbesHandle>>("Probes")
      .function("vectors", &ProbesHandle::vectors)
      .function("calibrate", &ProbesHandle::calibrate);
  function("suite", optional_override([] { return guarded([] { return listOf(reference::wholeSuite("/data")); }); }));
  function("readVector", &readVector);
  function("probes", optional_override([] { return std::make_shared<ProbesHandle>(); }));
  function("verdicts", &verdictNames);
  function("commonFault", &commonFault);
  function("deviceClass", &deviceClass);
  function("record", &record);
}

}  // namespace hemitex::web
