// The deferred picture; on the way its albedo goes into a PNG, its depth and normals into EXR files.
pipeline({name: "buffers", output: "ToneMap.color"});

pass("Cull");
const g = pass("GBuffer");
pass("SaveImage", {name: "Albedo", reads: {color: g.albedo}, file: "albedo-%04d.png"});
pass("SaveImage", {name: "Normal", reads: {color: g.normal}, file: "normal-%04d.exr"});
pass("SaveImage", {name: "Depth", reads: {color: g.depth}, file: "depth-%04d.exr"});
pass("TileLights");
pass("TiledLighting");
pass("CustomShaders");
pass("Background");
pass("Mirrors");
pass("Transparency");
pass("ToneMap");
