// Deferred shading in which all lights throw soft shadows, blurred in screen space in layers.
// Objects with shaders of their own are drawn first, so that shadows darken them, too.
pipeline({name: "layered", output: "ToneMap.color"});

pass("Cull");
pass("GBuffer");
pass("CustomShaders");
pass("ShadowMaps");
pass("TileLights");
pass("ShadowLayers", {layers: 32});
pass("ShadowMask");
pass("ShadowTiles");
pass("NearestBlockers");
pass("Penumbra", {method: "minimum", resolution: "half"});
pass("ShadowBlur", {kernel: 11, resolution: "half"});
pass("LayeredTransmittance", {method: "minimum", kernel: 11, resolution: "half"});
pass("TiledLighting", {shadows: "layered", comparison: "plane"});
pass("Background");
pass("Mirrors");
pass("Transparency");
pass("ToneMap");
