#include "reference/devices/vulkan/vulkan_sums.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

#include "raster/base/parallel.h"

// SPIR-V: CMake compiles the shaders to these arrays of integers.
#include <list_sums.h>
#include <sum_pixels.h>
#include <sum_pixels_in_halves.h>

namespace hemitex::reference {
namespace {

using raster::SlotSums;
using raster::SlotTable;
using raster::SummedView;

/// The twins of sums.glsl.
struct SummedFace {
  std::uint32_t width, height, weights, view;
};
struct ShaderTable {
  std::uint32_t bits, blocks;
  raster::ItemId backId;
  std::uint32_t back, words;
};
struct SumList {
  std::uint32_t first, count;
};
static_assert(sizeof(SlotTable::Block) == 12);

enum Binding : std::uint32_t { Ids, Faces, Weights, Blocks, Slots, Sums, Touched, Lists, ListedSlots, ListedSums };

std::array<vk::DescriptorType, 10> sumBindingTypes() {
  std::array<vk::DescriptorType, 10> types;
  types.fill(vk::DescriptorType::eStorageBuffer);
  types[Ids] = vk::DescriptorType::eSampledImage;
  return types;
}

/// What views that are drawn at once need.
struct Room {
  vk::Extent2D size{1, 1};  ///< of the largest face
  std::size_t faces = 0, views = 0;
  std::size_t listed = 0;  ///< sums that may be above 0

  bool holds(const Room& other) const {
    return size.width >= other.size.width && size.height >= other.size.height && faces >= other.faces &&
           views >= other.views && listed >= other.listed;
  }
};

/// The images and buffers of views that are drawn at once.
struct Place {
  Room room;
  Canvas canvas;
  VulkanBuffer faces, sums, touched, lists, listedSlots, listedSums;
  bool isNew = true;  ///< sums are not yet 0
};

/// Views under way.
struct Flight {
  vk::raii::CommandBuffer commands;
  vk::raii::Fence done;
  VulkanDescriptors descriptors;
  std::optional<Place> place = {};
  std::size_t first = 0, count = 0;  ///< of the views; none if it is idle
};

std::size_t pixelsOf(const SummedView& view) {
  std::size_t pixels = 0;
  for (const raster::Face& face : view.faces)
    pixels += static_cast<std::size_t>(face.scissor.width) * static_cast<std::size_t>(face.scissor.height);
  return pixels;
}

std::uint32_t dividedUp(std::uint32_t a, std::uint32_t b) { return (a + b - 1) / b; }

class VulkanSums final : public raster::PixelSums {
 public:
  VulkanSums(FaceDrawing& drawing, SlotTable table, bool inHalves);
  std::size_t addWeights(std::span<const std::uint64_t> before) override;
  std::vector<SlotSums> sum(std::span<const SummedView> views) override;

 private:
  Room roomWith(const Room& room, const SummedView& view) const;
  bool isTooLarge(const Room& room) const;
  void uploadWeights();
  void makeRoom(Flight& flight, const Room& needed);
  void start(Flight& flight, std::span<const SummedView> views, std::size_t first);
  void record(const Flight& flight, std::span<const SummedView> views);
  void recordSums(const Flight& flight, std::uint32_t faces, std::uint32_t views);
  void finish(Flight& flight, std::vector<SlotSums>& rows);

  FaceDrawing& drawing_;
  const VulkanContext& context_;
  SlotTable table_;
  ShaderTable constants_;
  std::size_t largestBuffer_;
  VulkanBuffer blocks_, slots_;
  std::vector<std::uint64_t> weights_;  ///< all tables, one after the other
  std::vector<std::uint32_t> firstWeights_;
  std::optional<VulkanBuffer> weightBuffer_;  ///< none if tables were added
  std::vector<Flight> flights_;
  vk::raii::PipelineLayout layout_;
  vk::raii::Pipeline sumPixels_, listSums_;
};

std::vector<Flight> makeFlights(const FaceDrawing& drawing) {
  std::vector<Flight> flights;
  for (int f = 0; f < 2; ++f)
    flights.push_back({makeCommands(drawing), vk::raii::Fence(drawing.context.device, vk::FenceCreateInfo()),
                       makeDescriptors(drawing.context, sumBindingTypes(), vk::ShaderStageFlagBits::eCompute)});
  return flights;
}

VulkanSums::VulkanSums(FaceDrawing& drawing, SlotTable table, bool inHalves)
    : drawing_(drawing),
      context_(drawing.context),
      table_(std::move(table)),
      constants_{static_cast<std::uint32_t>(table_.bits), static_cast<std::uint32_t>(table_.blocks.size()),
                 table_.backId, table_.back, dividedUp(static_cast<std::uint32_t>(table_.count()), 32)},
      largestBuffer_(context_.physicalDevice.getProperties().limits.maxStorageBufferRange),
      blocks_(makeStorageBuffer(context_, std::as_bytes(std::span(table_.blocks)))),
      slots_(makeStorageBuffer(context_, std::as_bytes(std::span(table_.slots)))),
      flights_(makeFlights(drawing)),
      layout_(makePipelineLayout(context_, flights_.front().descriptors,
                                 {.stageFlags = vk::ShaderStageFlagBits::eCompute, .size = sizeof(ShaderTable)})),
      sumPixels_(inHalves || !context_.addsInt64 ? makeComputePipeline(context_, layout_, sumPixelsInHalves)
                                                 : makeComputePipeline(context_, layout_, sumPixels)),
      listSums_(makeComputePipeline(context_, layout_, listSums)) {
  for (const Flight& flight : flights_) {
    bind(context_, flight.descriptors, Blocks, blocks_);
    bind(context_, flight.descriptors, Slots, slots_);
  }
}

std::size_t VulkanSums::addWeights(std::span<const std::uint64_t> before) {
  if ((weights_.size() + before.size()) * sizeof(before[0]) > largestBuffer_) return none;
  firstWeights_.push_back(static_cast<std::uint32_t>(weights_.size()));
  weights_.insert(weights_.end(), before.begin(), before.end());
  weightBuffer_.reset();
  return firstWeights_.size() - 1;
}

void VulkanSums::uploadWeights() {
  if (weightBuffer_) return;
  weightBuffer_ = makeStorageBuffer(context_, std::as_bytes(std::span(weights_)));
  for (const Flight& flight : flights_) bind(context_, flight.descriptors, Weights, *weightBuffer_);
}

Room VulkanSums::roomWith(const Room& room, const SummedView& view) const {
  const vk::Extent2D size = sizeOf(view.faces);
  return {.size = {std::max(room.size.width, size.width), std::max(room.size.height, size.height)},
          .faces = room.faces + view.faces.size(),
          .views = room.views + 1,
          .listed = room.listed + std::min(table_.count(), pixelsOf(view))};
}

bool VulkanSums::isTooLarge(const Room& room) const {
  constexpr std::size_t bytesAtOnce = std::size_t{1} << 28;
  return room.faces > facesAtOnce(drawing_, room.size) ||
         room.views * table_.count() * sizeof(std::uint64_t) > std::min(largestBuffer_, bytesAtOnce);
}

void VulkanSums::makeRoom(Flight& flight, const Room& needed) {
  if (flight.place && flight.place->room.holds(needed)) return;
  flight.place.reset();
  const auto buffer = [&](std::size_t bytes, BufferUse use) { return makeBuffer(context_, bytes, use); };
  flight.place.emplace(Place{needed, makeCanvas(drawing_, needed.size, needed.faces, needed.views),
                             buffer(needed.faces * sizeof(SummedFace), BufferUse::Input),
                             buffer(needed.views * table_.count() * sizeof(std::uint64_t), BufferUse::Device),
                             buffer(needed.views * constants_.words * sizeof(std::uint32_t), BufferUse::Device),
                             buffer((needed.views + 1) * sizeof(SumList), BufferUse::Output),
                             buffer(needed.listed * sizeof(std::uint32_t), BufferUse::Output),
                             buffer(needed.listed * sizeof(std::uint64_t), BufferUse::Output)});
  const Place& place = *flight.place;
  bind(context_, flight.descriptors, Ids, place.canvas.targets.colour, vk::DescriptorType::eSampledImage);
  for (const auto& [binding, bound] : {std::pair{Faces, &place.faces},
                                       {Sums, &place.sums},
                                       {Touched, &place.touched},
                                       {Lists, &place.lists},
                                       {ListedSlots, &place.listedSlots},
                                       {ListedSums, &place.listedSums}})
    bind(context_, flight.descriptors, binding, *bound);
}

/// Starts the views, the first of which has the number `first`.
void VulkanSums::start(Flight& flight, std::span<const SummedView> views, std::size_t first) {
  Room room;
  for (const SummedView& view : views) room = roomWith(room, view);
  makeRoom(flight, room);
  std::memset(flight.place->lists.bytes, 0, sizeof(SumList));
  std::vector<SummedFace> faces;
  for (std::uint32_t v = 0; v < views.size(); ++v)
    for (std::size_t f = 0; f < views[v].faces.size(); ++f) {
      const vk::Extent2D size = sizeOf(views[v].faces[f]);
      faces.push_back({size.width, size.height, firstWeights_[views[v].weights[f]], v});
    }
  std::memcpy(flight.place->faces.bytes, faces.data(), faces.size() * sizeof(SummedFace));
  record(flight, views);
  flight.place->isNew = false;
  context_.device.resetFences(*flight.done);
  submit(drawing_, flight.commands, *flight.done);
  flight.first = first;
  flight.count = views.size();
}

void VulkanSums::record(const Flight& flight, std::span<const SummedView> views) {
  const Place& place = *flight.place;
  const vk::raii::CommandBuffer& commands = flight.commands;
  commands.begin(vk::CommandBufferBeginInfo{.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  if (place.isNew) {
    commands.fillBuffer(*place.sums.buffer, 0, VK_WHOLE_SIZE, 0);
    commands.fillBuffer(*place.touched.buffer, 0, VK_WHOLE_SIZE, 0);
    awaitWrites(commands);
  }
  std::vector<DrawnView> drawn;
  std::uint32_t faces = 0;
  for (const SummedView& view : views) {
    drawn.push_back({view.faces, view.skipped});
    faces += static_cast<std::uint32_t>(view.faces.size());
  }
  reference::record(commands, drawing_, place.canvas, drawn, vk::ImageLayout::eShaderReadOnlyOptimal);
  recordSums(flight, faces, static_cast<std::uint32_t>(views.size()));
}

void VulkanSums::recordSums(const Flight& flight, std::uint32_t faces, std::uint32_t views) {
  constexpr auto compute = vk::PipelineBindPoint::eCompute;
  constexpr std::uint32_t groupColumns = 4 * 32, groupRows = 16;  // of sum_pixels.comp
  const vk::raii::CommandBuffer& commands = flight.commands;
  const vk::Extent2D size = flight.place->room.size;
  commands.bindDescriptorSets(compute, *layout_, 0, *flight.descriptors.set, {});
  commands.pushConstants<ShaderTable>(*layout_, vk::ShaderStageFlagBits::eCompute, 0, constants_);
  commands.bindPipeline(compute, *sumPixels_);
  commands.dispatch(dividedUp(size.width, groupColumns), dividedUp(size.height, groupRows), faces);
  awaitWrites(commands);
  commands.bindPipeline(compute, *listSums_);
  commands.dispatch(views, 1, 1);
}

/// Waits for the views of a flight, and reads their sums.
void VulkanSums::finish(Flight& flight, std::vector<SlotSums>& rows) {
  if (flight.count == 0) return;
  while (context_.device.waitForFences(*flight.done, true, UINT64_MAX) == vk::Result::eTimeout) {
  }
  const Place& place = *flight.place;
  const auto* const lists = reinterpret_cast<const SumList*>(place.lists.bytes) + 1;
  const auto* const slots = reinterpret_cast<const std::uint32_t*>(place.listedSlots.bytes);
  const auto* const sums = reinterpret_cast<const std::uint64_t*>(place.listedSums.bytes);
  raster::parallelFor(flight.count, [&](std::size_t v) {
    const auto [first, count] = lists[v];
    rows[flight.first + v] = {{slots + first, slots + first + count}, {sums + first, sums + first + count}};
  });
  flight.count = 0;
}

std::vector<SlotSums> VulkanSums::sum(std::span<const SummedView> views) try {
  std::vector<SlotSums> rows(views.size());
  uploadWeights();
  std::size_t flight = 0;
  for (std::size_t first = 0, end = 0; first < views.size(); first = end, ++flight) {
    Room room = roomWith({}, views[end++]);
    for (; end < views.size() && !isTooLarge(roomWith(room, views[end])); ++end) room = roomWith(room, views[end]);
    finish(flights_[flight % 2], rows);
    start(flights_[flight % 2], views.subspan(first, end - first), first);
  }
  finish(flights_[flight % 2], rows);
  finish(flights_[(flight + 1) % 2], rows);
  return rows;
} catch (const vk::SystemError& error) {
  throw failureOf(error);
}

}  // namespace

std::unique_ptr<raster::PixelSums> makeVulkanSums(FaceDrawing& drawing, const std::function<SlotTable()>& table,
                                                  bool inHalves) try {
  SlotTable slots = table();
  const std::size_t largest = drawing.context.physicalDevice.getProperties().limits.maxStorageBufferRange;
  if (slots.count() * sizeof(std::uint64_t) > largest || slots.slots.size() * sizeof(std::uint32_t) > largest)
    return nullptr;
  return std::make_unique<VulkanSums>(drawing, std::move(slots), inHalves);
} catch (const vk::SystemError& error) {
  throw failureOf(error);
}

}  // namespace hemitex::reference
