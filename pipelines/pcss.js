// Deferred shading in which all lights throw shadows with penumbrae, by percentage-closer soft shadows.
// Objects with shaders of their own are drawn first, so that shadows darken them, too.
pipeline({name: "pcss", output: "ToneMap.color"});

pass("Cull");
pass("GBuffer");
pass("CustomShaders");
pass("ShadowMaps");
pass("TileLights");
pass("TiledLighting", {shadows: "pcss", search: 5, kernel: 11});
pass("Background");
pass("Mirrors");
pass("Transparency");
pass("ToneMap");
