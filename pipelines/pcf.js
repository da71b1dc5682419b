// Deferred shading in which all lights throw shadows, smoothed by percentage-closer filtering.
// Objects with shaders of their own are drawn first, so that shadows darken them, too.
pipeline({name: "pcf", output: "ToneMap.color"});

pass("Cull");
pass("GBuffer");
pass("CustomShaders");
pass("ShadowMaps");
pass("TileLights");
pass("TiledLighting", {shadows: "pcf", kernel: 5});
pass("Background");
pass("Mirrors");
pass("Transparency");
pass("ToneMap");
