// Deferred shading in which all lights throw shadows: one comparison with its maps for each.
// Objects with shaders of their own are drawn first, so that shadows darken them, too.
pipeline({name: "hard", output: "ToneMap.color"});

pass("Cull");
pass("GBuffer");
pass("CustomShaders");
pass("ShadowMaps");
pass("TileLights");
pass("TiledLighting", {shadows: "hard", comparison: "plane"});
pass("Background");
pass("Mirrors");
pass("Transparency");
pass("ToneMap");
