// Deferred shading: one G-buffer, lit in full-screen passes; custom shaders, mirrors and glass are drawn forward.
// The default of `lucerna render`.
pipeline({name: "deferred", output: "ToneMap.color"});

pass("Cull");
pass("GBuffer");
pass("TileLights");
pass("TiledLighting");
pass("CustomShaders");
pass("Background");
pass("Mirrors");
pass("Transparency");
pass("ToneMap");
