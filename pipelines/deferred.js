// Deferred shading: one G-buffer, lit in full-screen passes; transparent surfaces are drawn forward.
// The default of `lucerna render`.
pipeline({name: "deferred", output: "ToneMap.color"});

pass("Cull");
pass("GBuffer");
pass("Lighting");
pass("Background");
pass("Transparency");
pass("ToneMap");
