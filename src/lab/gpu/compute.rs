//! A device of wgpu, whose errors are values: none of them prints, and none panics.

use std::sync::{Arc, Mutex, PoisonError};

use pollster::block_on;
use wgpu::{ErrorFilter, Features, PollType};

use super::adapter::{Adapter, AdapterKind, describe, DeviceFault};

/// A device and its queue.
pub(super) struct Compute {
    pub adapter: Adapter,
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    /// What the driver said when it lost the device, or of an error that no scope caught.
    lost: Arc<Mutex<Option<String>>>,
}

/// What is used of an adapter where it has it.
const FEATURES: Features = Features::PASSTHROUGH_SHADERS
    .union(Features::FLOAT32_BLENDABLE)
    .union(Features::FLOAT32_FILTERABLE)
    .union(Features::TEXTURE_FORMAT_16BIT_NORM)
    .union(Features::MAPPABLE_PRIMARY_BUFFERS)
    .union(Features::SHADER_F16)
    .union(Features::TIMESTAMP_QUERY);

/// How long a block may take. It is a fraction of a second on a processor of long ago; what takes longer never ends.
const PATIENCE: core::time::Duration = core::time::Duration::from_secs(120);

impl Compute {
    /// Opens a device on an adapter.
    pub fn open(adapter: &wgpu::Adapter) -> Result<Compute, DeviceFault> {
        let descriptor = wgpu::DeviceDescriptor {
            required_features: adapter.features() & FEATURES,
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) =
            block_on(adapter.request_device(&descriptor)).map_err(DeviceFault::lost)?;
        let lost = Arc::new(Mutex::new(None));
        let (of_loss, of_error) = (lost.clone(), lost.clone());
        device.set_device_lost_callback(move |_, why| note(&of_loss, why));
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            note(&of_error, error.to_string());
        }));
        Ok(Compute {
            adapter: describe(adapter),
            device,
            queue,
            lost,
        })
    }

    /// Whether the device has this.
    pub fn has(&self, features: Features) -> bool {
        self.device.features().contains(features)
    }

    /// Whether its memory is the processor's, so that results can be read where the shader wrote them.
    pub fn shares_memory(&self) -> bool {
        let shared = matches!(
            self.adapter.kind,
            AdapterKind::Software | AdapterKind::Integrated
        );
        shared && self.has(Features::MAPPABLE_PRIMARY_BUFFERS)
    }

    /// Does something, and takes up every error that it raised.
    pub fn guarded<T>(&self, work: impl FnOnce() -> T) -> Result<T, DeviceFault> {
        let filters = [
            ErrorFilter::OutOfMemory,
            ErrorFilter::Internal,
            ErrorFilter::Validation,
        ];
        let scopes = filters.map(|filter| self.device.push_error_scope(filter));
        let done = work();
        // Scopes end in the reverse of the order in which they began.
        let mut errors = scopes.into_iter().rev().map(|scope| block_on(scope.pop()));
        let [validation, internal, memory] = [(); 3].map(|()| errors.next().flatten());
        if let Some(why) = memory {
            return Err(DeviceFault::lost(why));
        }
        self.check_alive()?;
        match validation.or(internal) {
            Some(error) => Err(DeviceFault::refused(error)),
            None => Ok(done),
        }
    }

    /// Waits for what was submitted.
    pub fn wait(&self, submission: wgpu::SubmissionIndex) -> Result<(), DeviceFault> {
        let wait = PollType::Wait {
            submission_index: Some(submission),
            timeout: Some(PATIENCE),
        };
        match self.device.poll(wait) {
            Ok(_) => self.check_alive(),
            Err(wgpu::PollError::Timeout) => {
                // Dropping them would wait for ever.
                std::mem::forget((self.device.clone(), self.queue.clone()));
                let seconds = PATIENCE.as_secs();
                Err(DeviceFault::lost(format!(
                    "no end within {seconds} seconds"
                )))
            }
            Err(error) => Err(DeviceFault::lost(error)),
        }
    }

    fn check_alive(&self) -> Result<(), DeviceFault> {
        let lost = self.lost.lock().unwrap_or_else(PoisonError::into_inner);
        lost.as_ref()
            .map_or(Ok(()), |why| Err(DeviceFault::lost(why)))
    }
}

/// Keeps the first reason.
fn note(lost: &Mutex<Option<String>>, why: String) {
    lost.lock()
        .unwrap_or_else(PoisonError::into_inner)
        .get_or_insert(why);
}
