//! The adapter and device that frames are rendered with.

use crate::fault::Fault;
use crate::language::Text;

/// Which kind of adapter renders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum AdapterKind {
    /// Mesa's software driver: the same pictures on every machine.
    #[default]
    Software,
    /// A real graphics card.
    Gpu,
}

/// A device and what it is called.
#[derive(Clone, Debug)]
pub struct Device {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    /// Name of the adapter.
    pub renderer: String,
    /// Driver and its version.
    pub driver: String,
}

impl Device {
    /// Opens the first Vulkan adapter of this kind.
    pub fn open(kind: AdapterKind) -> Result<Self, Fault> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = wgpu::Backends::VULKAN;
        descriptor.flags = wgpu::InstanceFlags::empty();
        let instance = wgpu::Instance::new(descriptor);
        let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::VULKAN));
        let adapter = adapters.into_iter().find(|adapter| kind.matches(adapter.get_info().device_type));
        let adapter = adapter.ok_or_else(|| kind.missing())?;
        let info = adapter.get_info();
        let wanted = wgpu::Features::SHADER_F64 | wgpu::Features::SHADER_EARLY_DEPTH_TEST;
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("ggrade"),
            required_features: wgpu::Features::VERTEX_WRITABLE_STORAGE | (adapter.features() & wanted),
            // A fragment stage may have several outputs of four floats, and as many inputs as the driver takes.
            required_limits: wgpu::Limits {
                max_vertex_attributes: adapter.limits().max_vertex_attributes,
                max_inter_stage_shader_variables: adapter.limits().max_inter_stage_shader_variables,
                max_color_attachment_bytes_per_sample: adapter.limits().max_color_attachment_bytes_per_sample,
                ..wgpu::Limits::default()
            },
            memory_hints: wgpu::MemoryHints::MemoryUsage,
            ..Default::default()
        }))
        .map_err(|error| unusable(&info.name, &error))?;
        Ok(Self { device, queue, renderer: info.name, driver: format!("{} {}", info.driver, info.driver_info) })
    }
}

impl AdapterKind {
    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Software => "software",
            Self::Gpu => "gpu",
        }
    }

    fn matches(self, device: wgpu::DeviceType) -> bool {
        match self {
            Self::Software => device == wgpu::DeviceType::Cpu,
            Self::Gpu => device != wgpu::DeviceType::Cpu,
        }
    }

    fn missing(self) -> Fault {
        match self {
            Self::Software => Fault::new(Text::new(
                "no software Vulkan driver (lavapipe) was found",
                "ソフトウェアの Vulkan ドライバ (lavapipe) が見つかりません",
            ))
            .remedy(lost_descriptions().unwrap_or_else(|| {
                Text::new(
                    "On Debian and Ubuntu: apt-get install mesa-vulkan-drivers libvulkan1. `ggrade doctor` tells more.",
                    "Debian / Ubuntu では apt-get install mesa-vulkan-drivers libvulkan1 を実行してください。\
                     詳しくは `ggrade doctor` で調べられます。",
                )
            })),
            Self::Gpu => Fault::new(Text::new(
                "no graphics card with a Vulkan driver was found",
                "Vulkan ドライバのあるグラフィックスカードが見つかりません",
            ))
            .remedy(Text::new(
                "Use --adapter software, or install the card's Vulkan driver.",
                "--adapter software を使うか、グラフィックスカードの Vulkan ドライバを入れてください。",
            )),
        }
    }
}

/// What to do where the loader was told of drivers that are not there; `None` where it was not told of any.
fn lost_descriptions() -> Option<Text> {
    let (name, paths) = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"]
        .iter()
        .find_map(|name| Some((name, std::env::var_os(name).filter(|paths| !paths.is_empty())?)))?;
    let lost = std::env::split_paths(&paths).find(|path| !path.exists())?;
    let lost = lost.display();
    Some(Text::new(
        format!("{name} names {lost}, which is not there: unset it, or name lavapipe's description (lvp_icd.*.json)."),
        format!(
            "環境変数 {name} の指す {lost} がありません。この変数を取り消すか、lavapipe の設定ファイル (lvp_icd.*.json) を指定してください。"
        ),
    ))
}

fn unusable(name: &str, error: &wgpu::RequestDeviceError) -> Fault {
    Fault::new(Text::new(
        format!("the adapter {name} cannot be used: {error}"),
        format!("アダプタ {name} が使えません: {error}"),
    ))
    .remedy(Text::new(
        "It must let vertex shaders write to storage buffers (vertexPipelineStoresAndAtomics).",
        "頂点シェーダからストレージバッファへ書ける (vertexPipelineStoresAndAtomics) ことが必要です。",
    ))
}
