//! Every shader, through the front end, the validator and the WebGL2 back end of naga: what wgpu does
//! in the browser, without one.

use naga::{
    AddressSpace, ShaderStage, TypeInner,
    back::{PipelineConstants, glsl, pipeline_constants::process_overrides},
    valid::{Capabilities, ModuleInfo, ValidationFlags, Validator},
};

const FRAME: &str = include_str!("../../../src/render/shaders/frame.wgsl");

fn parse(name: &str, source: &str) -> (naga::Module, ModuleInfo) {
    let whole = format!("{FRAME}{source}");
    let module = naga::front::wgsl::parse_str(&whole)
        .unwrap_or_else(|e| panic!("{name}: {}", e.emit_to_string_with_path(&whole, name)));
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{name}: {}", e.emit_to_string_with_path(&whole, name)));
    (module, info)
}

/// GLSL ES 3.00 of an entry point, as WebGL2 takes it.
fn glsl_of(name: &str, module: &naga::Module, info: &ModuleInfo, stage: ShaderStage, entry: &str) -> String {
    let (module, info) =
        process_overrides(module, info, Some((stage, entry)), &PipelineConstants::default()).expect(name);
    let options = glsl::Options {
        version: glsl::Version::Embedded { version: 300, is_webgl: true },
        ..Default::default()
    };
    let pipeline = glsl::PipelineOptions { shader_stage: stage, entry_point: entry.into(), multiview: None };
    let mut out = String::new();
    glsl::Writer::new(&mut out, &module, &info, &options, &pipeline, Default::default())
        .and_then(|mut writer| writer.write())
        .unwrap_or_else(|e| panic!("{name}, {entry}: {e}"));
    out
}

fn check(name: &str, source: &str) {
    let (module, info) = parse(name, source);
    for (stage, entry) in [(ShaderStage::Vertex, "vertex"), (ShaderStage::Fragment, "fragment")] {
        let glsl = glsl_of(name, &module, &info, stage, entry);
        assert!(glsl.contains("void main()"), "{name}, {entry}");
    }
    for (_, variable) in module.global_variables.iter() {
        if variable.space == AddressSpace::Uniform {
            let size = module.types[variable.ty].inner.size(module.to_ctx());
            assert_eq!(size % 16, 0, "{name}: WebGL2 wants uniforms of whole 16 bytes, not {size}");
            assert!(size <= 16 << 10, "{name}: WebGL2 takes uniforms up to 16 KiB, not {size}");
        }
        let ty = &module.types[variable.ty].inner;
        let is_allowed = !matches!(variable.space, AddressSpace::Storage { .. })
            && !matches!(ty, TypeInner::Image { class: naga::ImageClass::Storage { .. }, .. });
        assert!(is_allowed, "{name}: WebGL2 has no storage buffers or textures");
    }
}

#[test]
fn background() {
    check("background.wgsl", include_str!("../../../src/render/shaders/background.wgsl"));
}

#[test]
fn mesh() {
    check("mesh.wgsl", include_str!("../../../src/render/shaders/mesh.wgsl"));
}

#[test]
fn solids() {
    check("solids.wgsl", include_str!("../../../src/render/shaders/solids.wgsl"));
}

#[test]
fn lines() {
    check("lines.wgsl", include_str!("../../../src/render/shaders/lines.wgsl"));
}

#[test]
fn discs() {
    check("discs.wgsl", include_str!("../../../src/render/shaders/discs.wgsl"));
}

#[test]
fn every_shader_is_checked() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/render/shaders");
    let mut names: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(
        names,
        ["background.wgsl", "discs.wgsl", "frame.wgsl", "lines.wgsl", "mesh.wgsl", "solids.wgsl"]
    );
}

#[test]
fn what_webgl_lacks_is_noticed() {
    let source = "@fragment fn fragment(@location(0) @interpolate(linear) v: f32) -> @location(0) vec4<f32> \
                  { return vec4<f32>(v); }\n\
                  @vertex fn vertex() -> @builtin(position) vec4<f32> { return vec4<f32>(0.0); }";
    assert!(std::panic::catch_unwind(|| check("linear", source)).is_err());
}
