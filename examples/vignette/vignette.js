// The deferred picture, darker towards its corners. Needs the plugin: --plugin vignette.so.
pipeline({name: "vignette"});

pass("Cull");
pass("GBuffer");
pass("TileLights");
pass("TiledLighting");
pass("CustomShaders");
pass("Background");
pass("Mirrors");
pass("Transparency");
pass("Vignette", {strength: 0.9});
pass("ToneMap");
