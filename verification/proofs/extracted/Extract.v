(* The checker of witnesses as a program of OCaml. Whole numbers are those of the library Zarith. *)
From Coq Require Import ExtrOcamlBasic ExtrOcamlZBigInt.
From Selvedge Require Corners Checker.
Extraction "checker.ml" Checker.accepts Corners.vertex_face Corners.edge_edge.
