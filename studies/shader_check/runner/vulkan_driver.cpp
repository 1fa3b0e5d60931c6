// Compute shaders on Vulkan: on the first hardware device, or else on a software one such as Mesa's lavapipe.
#include <vulkan/vulkan.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "studies/shader_check/runner/runner.hpp"

namespace lobelia::shader_runner {
namespace {

void check(VkResult result, const char* what, int code = kRunnerBroken) {
  if (result != VK_SUCCESS)
    throw Failure(code, std::string("Vulkan: ") + what + " failed with " + std::to_string(result));
}

int rank(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 2;
    default:
      return 3;
  }
}

class VulkanDriver : public Driver {
 public:
  VulkanDriver(const Work& work, std::span<const float> points) : work_(work) {
    make_instance();
    choose_device();
    make_device();
    points_ = make_buffer(points.size_bytes());
    std::memcpy(points_.data, points.data(), points.size_bytes());
    results_ = make_buffer(work.invocations() * 4 * sizeof(float));
    make_layout();
    bind_buffers();
  }

  std::string device() const override { return properties_.deviceName; }
  std::string version() const override {
    const std::uint32_t v = properties_.apiVersion;
    return "Vulkan " + std::to_string(VK_API_VERSION_MAJOR(v)) + "." +
           std::to_string(VK_API_VERSION_MINOR(v)) + "." + std::to_string(VK_API_VERSION_PATCH(v));
  }

  void add(const std::string& program) override {
    std::vector<std::uint32_t> words(program.size() / 4);
    std::memcpy(words.data(), program.data(), words.size() * 4);
    VkShaderModuleCreateInfo module{};
    module.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module.codeSize = words.size() * 4;
    module.pCode = words.data();
    VkComputePipelineCreateInfo pipeline{};
    pipeline.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    pipeline.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    pipeline.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    pipeline.stage.pName = "main";
    pipeline.layout = layout_;
    check(vkCreateShaderModule(device_, &module, nullptr, &pipeline.stage.module),
          "vkCreateShaderModule", kRunnerRefusedProgram);
    check(vkCreateComputePipelines(device_, VK_NULL_HANDLE, 1, &pipeline, nullptr,
                                   &pipelines_.emplace_back()),
          "vkCreateComputePipelines", kRunnerRefusedProgram);
  }

  void run(std::size_t k) override {
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    check(vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
    vkCmdFillBuffer(commands_, results_.buffer, 0, VK_WHOLE_SIZE, 0);
    VkMemoryBarrier filled{};
    filled.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    filled.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    filled.dstAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_TRANSFER_BIT,
                         VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1, &filled, 0, nullptr, 0,
                         nullptr);
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines_.at(k));
    vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0,
                            nullptr);
    const std::size_t groups = (work_.invocations() + kGroupSize - 1) / kGroupSize;
    vkCmdDispatch(commands_, std::uint32_t(std::min(groups, kGroupsInRow)),
                  std::uint32_t((groups + kGroupsInRow - 1) / kGroupsInRow), 1);
    VkMemoryBarrier written = filled;
    written.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    written.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                         VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &written, 0, nullptr, 0, nullptr);
    check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
    VkSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands_;
    check(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
    check(vkQueueWaitIdle(queue_), "vkQueueWaitIdle");
  }

  std::vector<float> results() override {
    std::vector<float> values(work_.invocations() * 4);
    std::memcpy(values.data(), results_.data, values.size() * sizeof(float));
    return values;
  }

 private:
  struct Buffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    void* data = nullptr;
  };

  void make_instance() {
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.apiVersion = VK_API_VERSION_1_2;
    VkInstanceCreateInfo instance{};
    instance.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    instance.pApplicationInfo = &application;
    check(vkCreateInstance(&instance, nullptr, &instance_), "vkCreateInstance", kRunnerNoDevice);
  }

  void choose_device() {
    std::array<VkPhysicalDevice, 16> devices{};
    std::uint32_t count = devices.size();
    const VkResult found = vkEnumeratePhysicalDevices(instance_, &count, devices.data());
    if (found != VK_INCOMPLETE) check(found, "vkEnumeratePhysicalDevices", kRunnerNoDevice);
    int best = 4;
    for (std::uint32_t i = 0; i < count; ++i) {
      VkPhysicalDeviceProperties properties;
      vkGetPhysicalDeviceProperties(devices[i], &properties);
      if (rank(properties.deviceType) >= best || properties.apiVersion < VK_API_VERSION_1_2 ||
          compute_family(devices[i]) < 0)
        continue;
      best = rank(properties.deviceType);
      chosen_ = devices[i];
      properties_ = properties;
    }
    if (!chosen_) throw Failure(kRunnerNoDevice, "Vulkan has no device of version 1.2");
  }

  static int compute_family(VkPhysicalDevice device) {
    std::array<VkQueueFamilyProperties, 16> families{};
    std::uint32_t count = families.size();
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (std::uint32_t i = 0; i < count; ++i)
      if (families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) return int(i);
    return -1;
  }

  void make_device() {
    // Half floats, where the device has them.
    VkPhysicalDeviceVulkan12Features known{}, wanted{};
    known.sType = wanted.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    VkPhysicalDeviceFeatures2 features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &known;
    vkGetPhysicalDeviceFeatures2(chosen_, &features);
    wanted.shaderFloat16 = known.shaderFloat16;
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = std::uint32_t(compute_family(chosen_));
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo device{};
    device.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    device.pNext = &wanted;
    device.queueCreateInfoCount = 1;
    device.pQueueCreateInfos = &queue;
    check(vkCreateDevice(chosen_, &device, nullptr, &device_), "vkCreateDevice", kRunnerNoDevice);
    vkGetDeviceQueue(device_, queue.queueFamilyIndex, 0, &queue_);
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = queue.queueFamilyIndex;
    VkCommandBufferAllocateInfo buffer{};
    buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    buffer.commandBufferCount = 1;
    check(vkCreateCommandPool(device_, &pool, nullptr, &buffer.commandPool), "vkCreateCommandPool");
    check(vkAllocateCommandBuffers(device_, &buffer, &commands_), "vkAllocateCommandBuffers");
  }

  /// In memory that the host sees.
  Buffer make_buffer(std::size_t bytes) {
    Buffer made;
    VkBufferCreateInfo buffer{};
    buffer.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    buffer.size = bytes;
    buffer.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    check(vkCreateBuffer(device_, &buffer, nullptr, &made.buffer), "vkCreateBuffer");
    VkMemoryRequirements needed;
    vkGetBufferMemoryRequirements(device_, made.buffer, &needed);
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(chosen_, &memory);
    constexpr VkMemoryPropertyFlags kSeen =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    VkMemoryAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocate.allocationSize = needed.size;
    while (allocate.memoryTypeIndex < memory.memoryTypeCount &&
           (!(needed.memoryTypeBits >> allocate.memoryTypeIndex & 1) ||
            (memory.memoryTypes[allocate.memoryTypeIndex].propertyFlags & kSeen) != kSeen))
      ++allocate.memoryTypeIndex;
    VkDeviceMemory block = VK_NULL_HANDLE;
    check(vkAllocateMemory(device_, &allocate, nullptr, &block), "vkAllocateMemory");
    check(vkBindBufferMemory(device_, made.buffer, block, 0), "vkBindBufferMemory");
    check(vkMapMemory(device_, block, 0, VK_WHOLE_SIZE, 0, &made.data), "vkMapMemory");
    return made;
  }

  void make_layout() {
    std::array<VkDescriptorSetLayoutBinding, 2> bindings{};
    for (std::uint32_t i = 0; i < bindings.size(); ++i)
      bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
    VkDescriptorSetLayoutCreateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set.bindingCount = bindings.size();
    set.pBindings = bindings.data();
    check(vkCreateDescriptorSetLayout(device_, &set, nullptr, &set_layout_),
          "vkCreateDescriptorSetLayout");
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &set_layout_;
    check(vkCreatePipelineLayout(device_, &layout, nullptr, &layout_), "vkCreatePipelineLayout");
  }

  void bind_buffers() {
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2};
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    VkDescriptorSetAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &set_layout_;
    check(vkCreateDescriptorPool(device_, &pool, nullptr, &allocate.descriptorPool),
          "vkCreateDescriptorPool");
    check(vkAllocateDescriptorSets(device_, &allocate, &set_), "vkAllocateDescriptorSets");
    const std::array<VkDescriptorBufferInfo, 2> buffers{
        {{points_.buffer, 0, VK_WHOLE_SIZE}, {results_.buffer, 0, VK_WHOLE_SIZE}}};
    std::array<VkWriteDescriptorSet, 2> writes{};
    for (std::uint32_t i = 0; i < writes.size(); ++i) {
      writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
      writes[i].dstSet = set_;
      writes[i].dstBinding = i;
      writes[i].descriptorCount = 1;
      writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
      writes[i].pBufferInfo = &buffers[i];
    }
    vkUpdateDescriptorSets(device_, writes.size(), writes.data(), 0, nullptr);
  }

  // The process ends soon, and the driver frees what is left.
  Work work_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkPhysicalDevice chosen_ = VK_NULL_HANDLE;
  VkPhysicalDeviceProperties properties_{};
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  Buffer points_, results_;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  std::vector<VkPipeline> pipelines_;
};

}  // namespace

std::unique_ptr<Driver> make_vulkan_driver(const Work& work, std::span<const float> points) {
  return std::make_unique<VulkanDriver>(work, points);
}

}  // namespace lobelia::shader_runner
