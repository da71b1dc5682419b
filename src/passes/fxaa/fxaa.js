// The deferred picture with smooth edges.
pipeline({name: "fxaa", output: "Fxaa.color"});

pass("Cull");
pass("GBuffer");
pass("TileLights");
pass("TiledLighting");
pass("CustomShaders");
pass("Background");
pass("Mirrors");
pass("Transparency");
pass("ToneMap");
pass("Fxaa");
