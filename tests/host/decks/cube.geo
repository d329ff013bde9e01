// cube.inp: gmsh -3 cube.geo -format inp -setnumber Mesh.SaveGroupsOfNodes 1 -o cube.inp   (Gmsh 4.8)
Point(1) = {0, 0, 0};
e[] = Extrude {1, 0, 0} { Point{1}; Layers{1}; };
s[] = Extrude {0, 1, 0} { Line{e[1]}; Layers{1}; };
v[] = Extrude {0, 0, 1} { Surface{s[1]}; Layers{1}; };
Physical Volume("body") = {v[1]}; Physical Surface("Top") = {v[0]}; Physical Surface("Bottom") = {s[1]};
