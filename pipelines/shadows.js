// Deferred shading in which all lights throw shadows, by shadow maps.
// Objects with shaders of their own are drawn first, so that shadows darken them, too.
pipeline({name: "shadows", output: "ToneMap.color"});

pass("Cull");
pass("GBuffer");
pass("CustomShaders");
pass("ShadowMaps");
pass("TileLights");
pass("TiledLighting");
pass("Background");
pass("Mirrors");
pass("Transparency");
pass("ToneMap");
