// Deferred shading with baked light: what `lucerna bake` made, and the lights that it left out.
// The default of `lucerna render --lightmap DIR`. Objects with shaders of their own, mirrors and glass add their baked
// light as they are drawn.
pipeline({name: "lightmapped", output: "ToneMap.color"});

pass("Cull");
pass("GBuffer", {baked: true});
pass("TileLights");
pass("TiledLighting");
pass("CustomShaders");
pass("Background");
pass("Mirrors");
pass("Transparency");
pass("ToneMap");
