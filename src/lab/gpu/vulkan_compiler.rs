//! A Vulkan device that compiles and never runs. With `RADV_FORCE_FAMILY` set, Mesa's driver for AMD GPUs offers a device of any
//! of its families, without the hardware. It reports statistics of pipelines by VK_KHR_pipeline_executable_properties.
//!
//! wgpu cannot open such a device, so this calls Vulkan itself.
#![allow(unsafe_code)]

use std::ffi::CStr;

use ash::{khr, vk};

use super::spirv::words;
use crate::lab::fault::Fault;

/// A device that compiles. It lives as long as the process: drivers leave threads behind.
pub struct VulkanCompiler {
    /// The driver's name of the device that it emulates.
    pub name: String,
    /// The driver and its version.
    pub driver: String,
    device: ash::Device,
    executables: khr::pipeline_executable_properties::Device,
    layout: vk::PipelineLayout,
    vertex: vk::ShaderModule,
}

/// A module of SPIR-V and an entry point of it.
#[derive(Clone, Copy, Debug)]
pub struct ModuleEntry<'a> {
    /// The module.
    pub module: &'a [u8],
    /// The entry point.
    pub name: &'a CStr,
}

const PACKAGES: &str = "on Debian install mesa-vulkan-drivers libvulkan1";
/// The format of the colour target: that of a renderer in linear light.
const FORMAT: vk::Format = vk::Format::R16G16B16A16_SFLOAT;

impl VulkanCompiler {
    /// Opens the device. The environment selects the family. All pipelines have this vertex shader.
    ///
    /// # Errors
    /// There is none.
    pub fn open(vertex: &[u8]) -> Result<VulkanCompiler, Fault> {
        let failed = |result: vk::Result| absent(&result.to_string());
        // SAFETY: a library of this name is the Vulkan loader, and what is called through it follows Vulkan: all structures
        // live to the end of the calls that take them, and handles are those of this device.
        unsafe {
            let entry = ash::Entry::load().map_err(|error| absent(&error.to_string()))?;
            let about = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_3);
            let wanted = vk::InstanceCreateInfo::default().application_info(&about);
            let instance = entry.create_instance(&wanted, None).map_err(failed)?;
            let all = instance.enumerate_physical_devices().map_err(failed)?;
            let mut played = all
                .into_iter()
                .filter_map(|physical| Some((physical, describe(&instance, physical)?)));
            let (physical, (name, driver)) = played
                .next()
                .ok_or_else(|| absent("it offers no device of this family"))?;
            let device = create(&instance, physical).map_err(failed)?;
            let compiler = VulkanCompiler {
                name,
                driver,
                executables: khr::pipeline_executable_properties::Device::new(&instance, &device),
                layout: layout(&device).map_err(failed)?,
                vertex: module(&device, vertex).map_err(failed)?,
                device,
            };
            // Never unloaded, since the device is never destroyed.
            std::mem::forget(entry);
            Ok(compiler)
        }
    }

    /// The compiler's statistics of a fragment shader, under its own names.
    ///
    /// # Errors
    /// The driver refuses it, with this message.
    pub fn measure(
        &self,
        vertex: &CStr,
        fragment: ModuleEntry,
    ) -> Result<Vec<(String, f64)>, Fault> {
        // SAFETY: as in `open`; the module and the pipeline are destroyed once, when they are no longer needed.
        let statistics = unsafe {
            let module = module(&self.device, fragment.module).map_err(Fault::refused)?;
            let measured = self
                .pipeline(vertex, module, fragment.name)
                .and_then(|pipeline| {
                    let statistics = self.statistics(pipeline);
                    self.device.destroy_pipeline(pipeline, None);
                    statistics
                });
            self.device.destroy_shader_module(module, None);
            measured
        };
        statistics.map_err(Fault::refused)
    }

    unsafe fn pipeline(
        &self,
        vertex: &CStr,
        fragment: vk::ShaderModule,
        name: &CStr,
    ) -> Result<vk::Pipeline, vk::Result> {
        let stage = |stage, module| {
            let info = vk::PipelineShaderStageCreateInfo::default();
            info.stage(stage).module(module)
        };
        let stages = [
            stage(vk::ShaderStageFlags::VERTEX, self.vertex).name(vertex),
            stage(vk::ShaderStageFlags::FRAGMENT, fragment).name(name),
        ];
        let input = vk::PipelineVertexInputStateCreateInfo::default();
        let assembly = vk::PipelineInputAssemblyStateCreateInfo::default()
            .topology(vk::PrimitiveTopology::TRIANGLE_LIST);
        let viewport = vk::PipelineViewportStateCreateInfo::default()
            .viewport_count(1)
            .scissor_count(1);
        let raster = vk::PipelineRasterizationStateCreateInfo::default().line_width(1.0);
        let samples = vk::PipelineMultisampleStateCreateInfo::default()
            .rasterization_samples(vk::SampleCountFlags::TYPE_1);
        let all = vk::ColorComponentFlags::RGBA;
        let attachments = [vk::PipelineColorBlendAttachmentState::default().color_write_mask(all)];
        let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&attachments);
        let states = [vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR];
        let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&states);
        let formats = [FORMAT];
        let mut rendering =
            vk::PipelineRenderingCreateInfo::default().color_attachment_formats(&formats);
        let wanted = vk::GraphicsPipelineCreateInfo::default()
            .flags(vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR)
            .stages(&stages)
            .vertex_input_state(&input)
            .input_assembly_state(&assembly)
            .viewport_state(&viewport)
            .rasterization_state(&raster)
            .multisample_state(&samples)
            .color_blend_state(&blend)
            .dynamic_state(&dynamic)
            .layout(self.layout)
            .push_next(&mut rendering);
        // SAFETY: all structures live to the end of the call.
        let made = unsafe {
            let cache = vk::PipelineCache::null();
            self.device
                .create_graphics_pipelines(cache, &[wanted], None)
        };
        made.map(|made| made[0]).map_err(|(_, result)| result)
    }

    unsafe fn statistics(&self, pipeline: vk::Pipeline) -> Result<Vec<(String, f64)>, vk::Result> {
        let of = vk::PipelineInfoKHR::default().pipeline(pipeline);
        // SAFETY: the pipeline was made to keep its statistics.
        unsafe {
            let parts = self.executables.get_pipeline_executable_properties(&of)?;
            let is_fragment = |part: &vk::PipelineExecutablePropertiesKHR| {
                part.stages.contains(vk::ShaderStageFlags::FRAGMENT)
            };
            let found = parts.iter().position(is_fragment);
            let index = found.ok_or(vk::Result::ERROR_UNKNOWN)? as u32;
            let info = vk::PipelineExecutableInfoKHR::default()
                .pipeline(pipeline)
                .executable_index(index);
            let statistics = self.executables.get_pipeline_executable_statistics(&info)?;
            Ok(statistics.iter().map(|one| statistic(one)).collect())
        }
    }
}

/// A statistic as a name and a number.
unsafe fn statistic(one: &vk::PipelineExecutableStatisticKHR) -> (String, f64) {
    // SAFETY: the format says which of the union's members was written.
    let value = unsafe {
        match one.format {
            vk::PipelineExecutableStatisticFormatKHR::INT64 => one.value.i64 as f64,
            vk::PipelineExecutableStatisticFormatKHR::UINT64 => one.value.u64 as f64,
            vk::PipelineExecutableStatisticFormatKHR::FLOAT64 => one.value.f64,
            _ => f64::from(one.value.b32),
        }
    };
    (text(one.name_as_c_str().ok()), value)
}

fn text(text: Option<&CStr>) -> String {
    text.map(|text| text.to_string_lossy().into_owned())
        .unwrap_or_default()
}

/// The device's name and its driver's, where the driver is this one.
unsafe fn describe(
    instance: &ash::Instance,
    physical: vk::PhysicalDevice,
) -> Option<(String, String)> {
    let mut driver = vk::PhysicalDeviceDriverProperties::default();
    let mut device = vk::PhysicalDeviceProperties2::default().push_next(&mut driver);
    // SAFETY: the chain lives to the end of the call.
    unsafe { instance.get_physical_device_properties2(physical, &mut device) };
    let name = text(device.properties.device_name_as_c_str().ok());
    let version = text(driver.driver_info_as_c_str().ok());
    let is_this = driver.driver_id == vk::DriverId::MESA_RADV;
    is_this.then(|| (name, format!("RADV, {version}")))
}

unsafe fn create(
    instance: &ash::Instance,
    physical: vk::PhysicalDevice,
) -> Result<ash::Device, vk::Result> {
    let priorities = [1.0];
    let queues = [vk::DeviceQueueCreateInfo::default().queue_priorities(&priorities)];
    let names = [khr::pipeline_executable_properties::NAME.as_ptr()];
    let mut executables = vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default()
        .pipeline_executable_info(true);
    let mut rendering =
        vk::PhysicalDeviceDynamicRenderingFeatures::default().dynamic_rendering(true);
    let mut half = vk::PhysicalDeviceShaderFloat16Int8Features::default().shader_float16(true);
    let mut storage = vk::PhysicalDevice16BitStorageFeatures::default()
        .storage_buffer16_bit_access(true)
        .uniform_and_storage_buffer16_bit_access(true);
    // SAFETY: the chains live to the end of the calls.
    unsafe {
        let mut has = vk::PhysicalDeviceShaderFloat16Int8Features::default();
        let mut features = vk::PhysicalDeviceFeatures2::default().push_next(&mut has);
        instance.get_physical_device_features2(physical, &mut features);
        let wanted = vk::DeviceCreateInfo::default()
            .queue_create_infos(&queues)
            .enabled_extension_names(&names)
            .push_next(&mut executables)
            .push_next(&mut rendering);
        // Families without 16-bit arithmetic get none.
        let wanted = if has.shader_float16 == vk::TRUE {
            wanted.push_next(&mut half).push_next(&mut storage)
        } else {
            wanted
        };
        instance.create_device(physical, &wanted, None)
    }
}

/// Group 0: arguments at binding 0, a texture at 3, its sampler at 4.
unsafe fn layout(device: &ash::Device) -> Result<vk::PipelineLayout, vk::Result> {
    let binding = |binding, ty| {
        vk::DescriptorSetLayoutBinding::default()
            .binding(binding)
            .descriptor_type(ty)
            .descriptor_count(1)
            .stage_flags(vk::ShaderStageFlags::FRAGMENT)
    };
    let bindings = [
        binding(0, vk::DescriptorType::UNIFORM_BUFFER),
        binding(3, vk::DescriptorType::SAMPLED_IMAGE),
        binding(4, vk::DescriptorType::SAMPLER),
    ];
    let group = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
    // SAFETY: both structures live to the end of the calls.
    unsafe {
        let groups = [device.create_descriptor_set_layout(&group, None)?];
        let wanted = vk::PipelineLayoutCreateInfo::default().set_layouts(&groups);
        device.create_pipeline_layout(&wanted, None)
    }
}

unsafe fn module(device: &ash::Device, bytes: &[u8]) -> Result<vk::ShaderModule, vk::Result> {
    let words = words(bytes);
    let wanted = vk::ShaderModuleCreateInfo::default().code(&words);
    // SAFETY: the words live to the end of the call, and are a module that naga wrote.
    unsafe { device.create_shader_module(&wanted, None) }
}

fn absent(why: &str) -> Fault {
    Fault::Absent(format!("no Vulkan driver RADV ({why}); {PACKAGES}"))
}
