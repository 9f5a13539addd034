(* Reads a file of witnesses (docs/witnesses.md), and has the checker that Coq extracted decide each record.

   check_witnesses FILE    exits with status 1 if a proof is refused, or the file is invalid *)
module Integer = Z
open Checker

exception Invalid of string

(* How often a part is halved to find the sign of its volume. *)
let halvings = List.fold_left (fun n () -> S n) O (List.init 80 ignore)

(* A number as n * 2^e. *)
let exact bits =
  let field = Int64.(to_int (logand (shift_right_logical bits 52) 2047L)) in
  let fraction = Integer.of_int64 (Int64.logand bits 0xfffffffffffffL) in
  if field = 2047 then raise (Invalid "number");
  let n = if field = 0 then fraction else Integer.add fraction (Integer.shift_left Integer.one 52) in
  ((if Int64.compare bits 0L < 0 then Integer.neg n else n), max field 1 - 1075)

let lowest = List.fold_left (fun low (n, e) -> if Integer.equal n Integer.zero then low else min low e) 0
(* The same number with the denominator 2^-low. *)
let over low (n, e) =
  { qnum = (if Integer.equal n Integer.zero then n else Integer.shift_left n (e - low)); qden = Integer.shift_left Integer.one (-low) }

let () =
  let file = open_in_bin Sys.argv.(1) in
  let byte () = input_byte file in
  let int64 () = String.get_int64_le (really_input_string file 8) 0 in
  let index () = Int32.to_int (String.get_int32_le (really_input_string file 4) 0) land 0xffffffff in
  let number () = exact (int64 ()) in
  let vector () = let x = number () in let y = number () in (x, y, number ()) in
  let check_record positions kind =
    let vertices = Array.init 4 (fun _ -> index ()) in
    let answer = byte () in
    let until = number () in
    if answer > 1 || answer = 0 && over (-52) until <> over (-52) (Integer.one, 0) then raise (Invalid "answer");
    let part _ =
      let proof = byte () in
      if proof > 3 then raise (Invalid "proof");
      let until = number () in
      (until, List.init proof (fun _ -> vector ())) in
    let parts = List.init (byte ()) part in
    let point vertex =
      if vertex >= Array.length (fst positions) then raise (Invalid "vertex");
      ((fst positions).(vertex), (snd positions).(vertex)) in
    let points = Array.map point vertices in
    let all (x, y, z) = [ x; y; z ] in
    let of_points = lowest (List.concat_map (fun (a, b) -> all a @ all b) (Array.to_list points)) in
    let of_directions = lowest (List.concat_map (fun (_, ws) -> List.concat_map all ws) parts) in
    let of_times = lowest (until :: List.map fst parts) in
    let along low (x, y, z) =
      let x = over low x and y = over low y and z = over low z in
      function X -> x | Y -> y | Z_ -> z in
    let along_points = Array.map (fun (a, b) -> (along of_points a, along of_points b)) points in
    let rec place = function O -> 0 | S n -> 1 + place n in
    let at (Coordinate (n, time, axis)) =
      let start, finish = along_points.(place n) in
      (match time with Start -> start | End -> finish) axis in
    let proof (until, ws) =
      let proof = match List.map (along of_directions) ws with
        | [] -> Volume | [ w ] -> Held w | [ v; w ] -> Turning (v, w) | [ v; m; w ] -> Curving (v, m, w)
        | _ -> raise (Invalid "proof") in
      (over of_times until, proof) in
    let pairs = match kind with 0 -> vertex_face | 1 -> edge_edge | _ -> raise (Invalid "kind") in
    accepts halvings at pairs (over 0 (Integer.zero, 0)) (List.map proof parts) (over of_times until) in
  try
    if really_input_string file 8 <> "SLVWIT01" then raise (Invalid "first bytes");
    if fst (number ()) <> Integer.zero then raise (Invalid "separation: the checker is for none");
    let count = index () in
    let frame () = Array.init count (fun _ -> vector ()) in
    let start = frame () in
    let positions = (start, frame ()) in
    for _ = 1 to 3 * index () do ignore (index ()) done;
    let rec check records refused = match byte () with
      | exception End_of_file -> (records, refused)
      | kind ->
        let holds = check_record positions kind in
        if not holds then Printf.printf "record %d is refused\n" records;
        check (records + 1) (if holds then refused else refused + 1) in
    let records, refused = check 0 0 in
    Printf.printf "%d records, %d refused\n" records refused;
    exit (if refused = 0 then 0 else 1)
  with
  | Invalid what -> Printf.eprintf "invalid %s\n" what; exit 1
  | End_of_file -> Printf.eprintf "the file ends within a record\n"; exit 1
