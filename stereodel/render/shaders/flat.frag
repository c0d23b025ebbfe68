#version 330 core
// Colours as they stand, times those of a texture, times the light that falls on a ball.

// Direction toward the light in view axes (right, up, toward): from the upper left, in front.
const vec3 LIGHT = normalize(vec3(-0.35, 0.45, 0.82));
// How much darker a ball is where it is turned away from the light.
const float SHADE = 0.36;

#ifdef HAS_BASE_COLOR_TEX
struct Material { sampler2D base_color_texture; };
uniform Material material;
in vec2 texel;
#endif
#ifdef TANGENT_LOC
// Centre and radii in pixels of the window, of the whole triangle; radii of zero: no ball, and full light.
flat in vec4 ball;
#endif
in vec4 color;
out vec4 frag_color;

void main()
{
    frag_color = color;
#ifdef HAS_BASE_COLOR_TEX
    frag_color *= texture(material.base_color_texture, texel);
#endif
#ifdef TANGENT_LOC
    if (ball.z > 0.0) {
        // The normal is told by where the pixel is, so triangles may be of any shape and size.
        vec2 across = (gl_FragCoord.xy - ball.xy) / ball.zw;
        vec3 normal = vec3(across, sqrt(max(0.0, 1.0 - dot(across, across))));
        // Smooth from the lit point to the opposite one: Lambert's law would show its terminator as an edge.
        float away = (1.0 - dot(normal, LIGHT)) / 2.0;
        frag_color.rgb *= 1.0 - SHADE * away * away;
    }
#endif
    frag_color = clamp(frag_color, 0.0, 1.0);
}
