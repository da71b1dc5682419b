// The deferred picture with ink lines where depth or direction jump: a pass without C++.
pipeline({name: "edges", output: "Edges.color"});

pass("Cull");
const g = pass("GBuffer");
pass("TileLights");
pass("TiledLighting");
pass("CustomShaders");
pass("Background");
pass("Mirrors");
pass("Transparency");
const toned = pass("ToneMap");
pass("Fullscreen", {
  name: "Edges",
  shader: "edges.frag",
  reads: {color: toned.color, depth: g.depth, normal: g.normal},
  params: {ink: [0.03, 0.02, 0.08], crease: 40},
  format: "Rgba8Unorm",
  halo: 1,
});
