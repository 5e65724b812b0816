"""Requests that look like what the reader reads without asking, and are not: none of them may be accepted."""

AIR = """
send the rover to bass
send the rover to Rovre
search the northern lights
search the Nroth half
find the biker
find the bikers
find the hike
send the drover to base
send the rover to baste
search the south hall
search the noth half
search the soth half
search nth half
search the east hlaf, but not now
send the rvoer to bed
send the rover to bsae_2
send the rovr_2 to base
search the wets half
search the norht_half2
find the hiekr tomorrow
don't serach the north half
dont snd the rover to base
dno't send the rover to base
nto search the north half
unles it rains search the north half
search the north half utnil noon
serach the north half or the south half
serach the area xecept the north half
send the rover to abse or (3, 3)
send the rover to (3, t)
serach the area tiwce
is the rover needed at base
the rover is not needed at base
the rover is no longer needed at base
the rover was needed at base
the rover was needed at base yesterday
the rover is needed at base tomorrow
the rover is needed at base if it rains
the rover isn't needed at base
the rover is needed nowhere
why is the rover needed at base
the rover is hardly needed at base
rover or base
rover, not base
rover, no base
not rover, base
rover? base
is rover, base
rover. base?
rover, base, (3, 3)
rover, drone, base
rover base camp
rover, the old base
rover, other base
hiker, no north half
hiker, north half or south half
north half, south half
drone, base
drone: base
drone -> base
rover -> base -> (3, 3)
rover -> nowhere
rover -> hangar
rover <- base
base -> rover
rover -/> base
no rover -> base
rover -> base?!? never
search of the north half cancelled
search of the north half is over
the search of the north half was long
the search of the north half failed
has the search of the north half begun
cancel the recon of the north half
no recon of the north half
recon of the north half is done
no delivery
report on the search of the north half
my mother says search the north half
my brother said to search the north half
send the rover to my mother
send the rover to the woman
send the rover to my brother and find my sister
find my brother and send the rover to my mother
find the hiker and send the rover to my wife
find the man, not the woman
find the man and send the rover to the woman
my brother is not lost, search the north half
my brother is lost if he is not back by noon, find him
my brother is lost in the north half, search the south half for my sister and send the rover to her
nobody is lost, search the north half
find the man with the dog
find the man in the red coat
find my brother's bag
search the man's house
find the people
find all the men
see if there is a fire in the north half
see if the rover is at base
check if you should search the north half
see if anyone is hurt before you search the north half
see if there is anyone in the village
find out whether anyone searched the north half
tell me if you search the north half
see if you can't find the hiker
see who is at base
check if there is nobody in the north half
let me know if anyone searches the north half
why don't we ask first and search the north half
is it possible that the rover is at base
any chance the rover is at base
any chance that anyone is in the north half by now, or not
how about not searching the north half
how about we don't search the north half
I would love not to search the north half
I'd love it if nobody searched the north half
return to base
return, base
return the drone to base
return to the north half
return the rover
return to base if you can
the rover must be at base
the rover should be at base
the rover could be at base
the rover may be at base
the rover must be near base
the rover has to be at base by noon
it must be at base
it has to be searched
it needs to go to base
this is control, disregard, search the north half
control to iris: do not search the north half
control to rover: go to control
control to control: search the north half
new task: none
task cancelled: search the north half
no new task: search the north half
old task: search the north half
yesterday's task: search the north half
example: search the north half
quote: search the north half
joke: rover to base
task for the drone: rover to base
what about the rover going to base
find the man who is not lost
find the man who lost the drone
find the man who got lost in the village
find the man who was found
send the rover to the man who got lost
search the north half once she is ready
search the north half as soon as he is back
send the rover to base once she is found
is there any chance of the rover going to base
report to base
search the north half and report to base
the hiker is waiting for the rover
the rover was to go to base
is the rover to go to base
the rover is to stay at base
the rover is to go to base at noon
is the drone to search the north half
why is the drone to search the north half
do a short search of the north half
do a second search of the north half
do half a search of the north half
kick the rover off base
as for the rover, leave it
regarding the rover: no base
send someone to search the north half tomorrow
have you someone at base
to base
to base with the drone
to base, not the rover
back base
go back
the rover is able to go to base
the drone might be able to search the north half
it is not time for the rover to go home
task for nobody: rover to base
mission for tomorrow: rover to base
search the west gate
search the north pole
search the field hospital
search the site office
search the area code
search west ham
send the rover to the loading base
send the rover to the parking base
wait at base
wait, at base
drone, wait at base
wait until the rover is at base
rover wait at the corner
go up and don't search the north half
the hiker must be in the north half or the south half, search it
the hiker was in the north half
the hiker is probably in the north half
the hiker reported that the south half is safe, send the rover
missing: the rover, at base
go to er, base or, um, the hangar
rover to 3, uh, 5, uh, 7
search at 5, er, 8 metres in the north half
rover to (1, 1), um, (2, 2)
rover to base, er, (2, 2)
search the north half, er, the south half
send the drone, um, the rover, to base
search the north, that is, the east
search the north half, I mean everything
send the rover to base, to the drone I mean
find the hiker, well, the car
send the drone, I mean the rover, to base
fly the drone to the north half
have the drone fly east
rover, drone, go to base
we are done searching, but search the north half
somebody else needs the drone in the north half
son, find me a job
find my son, he goes to base
for the night, send the rover to base
find the missing snowman
find the missing talisman
find the missing man's bag
find the missing rover driver
find the missing tool box
search for the lost user manual
send the drone to the rover driver
put the rover over the north half
land it, I mean the rover
bring the rover to a garage
search the north half over there in the east
rover 5 m forward, then the drone searches the north half
move the rover to base, 5 m, and search with the drone
the rover meets the drone at base
the rover halted, search the north half
is he in the north half
he is not in the north half, search it
my bag never came back from the north half
search the north half until noon
search the north half until it finds the car
search the north half until you find nothing
wait until it finds the hiker, then send the rover
"""

INDOOR = """
bring the bootle to room_a
bring the battle to room_a
bring the kettle to room_a
bring the tube to room_a
bring me the cub, please
bring the Botlte to room_a
bring the bottl_e2 to room_a
put the cube on tbale_c
put the cube on the tabel c
put the cube on the stable
put the cube on the tablet
take the bottle to the mom
take the bottle to roam a
take the bottle to rom_c
send the hog to the charger
send the dg to the charger
send the god to the charger
send the dog to the changer
send the dog to the charge
dno't bring the bottle to room_a
bring the bottel to room_a unles it is full
brign the bottle or the cube to room_a
take the botttle to room_a, nto room_b
never tkae the bottle to room_a
the bottle is not needed in room_b
the bottle is no longer wanted in room_b
the bottle was wanted in room_b
is the bottle wanted in room_b
who said the bottle is wanted in room_b
the bottle is wanted in room_b tomorrow
the bottle isn't wanted in room_b
the bottle is wanted in the kitchen
bottle, room_a
bottle. room_a
bottle? room_a
bottle: room_a or room_b
bottle: not room_a
bottle, cube, room_a
bottle, cube
bottle: kitchen
bottle -> kitchen
bottle -> room_a -> room_b
hammer -> room_a
bottle <- room_a
room_a -> bottle
no bottle -> room_a
dog: room_a, room_b
dog, not room_a
dog, no charger
dog? charger
dog. charger?
is the dog, charger
dog, cat, charger
cat, charger
dog charger room
delivery of the bottle to room_a was late
delivery of the bottle to room_a is done
the delivery of the bottle to room_a failed
the delivery of the bottle to room_a took an hour
no delivery of the bottle to room_a
cancel the delivery of the bottle to room_a
delivery of the bottle to room_a tomorrow
delivery of the bottle to the kitchen
delivery refused: bottle to room_a
delivery cancelled: bottle to room_a
delivery order: hammer to room_a
delivery order: bottle to room_a or room_b
old delivery order: bottle to room_a
the transfer of the bottle to room_a was yesterday
who ordered the delivery of the bottle to room_a
bottle for the kitchen
bottle for nobody in room_a
no bottle for room_b
was the bottle for room_b
patient in room_a needs no bottle
patient in room_a needs the bottle gone
patient in room_a does not need the bottle
the patient in room_a needed the bottle
if the patient in room_a needs the bottle bring it
the nurse in room_a needs the hammer
the visitor in room_a wants the bottle or the cube
the visitor from room_a needs the bottle
somebody took the cube to room_a
somebody should not take the cube to room_a
someone takes the cube to room_a
fetch nothing
fetch the hammer
fetch the bottle from the kitchen
fetch the bottle tomorrow
fetch the bottle and the cube
don't fetch the bottle
fetch the bottle or not
fetch the dog
bring the bottle somewhere
bring the bottle elsewhere
bring the bottle to him
bring the bottle away
could I get the dog
could I get the hammer
could I not get the bottle
might I have had the bottle
could I have the bottle or the cube
could we get the bottle gone
I'd be grateful for no bottle
I'd be grateful for the hammer
I would be happy to keep the bottle
arrange for nobody to take the bottle to room_a
see that nobody takes the bottle to room_a
see that the bottle stays in room_a
wait in the kitchen
wait in room_a or room_b
dog, wait
dog, wait in the corridor
don't wait in room_a
wait until the dog is in room_a
go to the loading dock
take the bottle to the loading dock
go to the docking station
go to the unloading point
go to the waiting room a
go to the dressing room b
that bottle there, no
put the bottle there
the cube there, leave it
the bottle must be in room_a
the bottle should be in room_a
the bottle may be in room_a
the bottle might be in room_a, bring the cube there
the nice bottle to room_a
take the little cube to room_a
take the other cube to room_a
take the poor cube to room_a
take the good bottle to room_a
go to the nice room
my hands are full, give me the bottle
my legs are the dog's, send the dog to the charger
I can't give the bottle to room_a
I can't let you take the bottle to room_a
I cannot have the dog go to the charger
sorry, not the bottle
sorry to say, the dog must not go to the charger
I hate to ask, but don't take the bottle to room_a
I'd love the hammer
I'd love the dog gone
I would love it if nobody took the bottle to room_a
how about the dog stays in room_a
what about the bottle
put the cube on table_b, I don't want that
put the cube on table_b, I don't need it
bring the bottle to room_a, uh, room_b
bring the bottle, er, the cube to room_a
dog to room_a, er, room_b
put it on table_a, um, table_b
let me get the bottle
let me take the bottle to room_a
let me not have the bottle
I'll take the bottle to room_a myself
I will have had the bottle
the bottle is not for room_b
is the bottle for room_b
the bottle is for the nurse in the kitchen
the cube goes nowhere
the cube went on table_b
the cube does not go on table_b
my colleague needs the bottle in the kitchen
my colleague needed the bottle in room_b
my colleague does not need the bottle in room_b
room_a is waiting for the dog
to the charger or to room_a, dog
to room_c, dog
the dog must not charge
the dog should charge later
is the dog to charge
charge the customer
carry the cube to room_b and come back
I can't hand the bottle over
I can't carry the bottle, nor should the dog
take the bottle and put it on the shelf
pick up the cube and put it on table_a or table_b
grab the cube for my brother
put the cube on table_a and send the dog to charge
move the dog to room_a, and afterwards put the bottle on table_a
place the bottle on the second table, then walk the dog to the drop off
pick up the cube and send the dog to room_a
grab the bottle and walk the dog to the charger
lift the bottle up, the dog shall go to room_b
bring me the bottle, I'm in the way
bring me the bottle, I'm right behind it
bring me the bottle, I am in danger
bring me the bottle, I'm out
bring me the bottle when I'm in the other room
bring me the bottle, I am on the floor in front of the dog
hand me the cube, my hands are full
take the bottle to room_a, I'm standing next to the dog
send the dog to room_a, I'm sitting in the corridor
send the dog to room_b, I can't get up from the floor
take the bottle to room_a, I mean room_b
take the bottle, or the cube I mean, to room_a
put it on table_a, er, table_b
take the bottle, sorry, the cube, to room_a
send the dog to the charger, that is, the dropoff
hand me the water, the soda I mean
hand me the bottle, I need it for an hour
hand me the bottle, I want to play with the dog
hand me the cube, I want to throw it at the dog
take the bottle to room_a, I need it for an hour
cube to room_b with care
cube to room_b without the dog
bottle to room_a, not by dog
bring me the bottle for the night
nobody needs the bottle in room_a
who needs the bottle in room_a?
the sign says room_a needs the bottle
nobody wants the quadruped in room_b, does he
assign the dog: nothing
I'm done with the dog
put the bottle into his hand
put the bottle in my pocket
put the bottle in my hand tomorrow
don't put the bottle in my hand
leave the bottle in my hand
put the bottle in my hand if I ask
put the bottle in the nurse's hand
put the bottle in my left hand
the bottle is in my hand
take the bottle to my house
take the bottle to my wife
bring the bottle to my brother's chair
bring the bottle to his chair
bring the bottle to where I was sitting
bring the bottle to where I sat yesterday
take the bottle to where she sits
bring the bottle to my room
bring the bottle to my old table
put the bottle on my desk
put the cube on my chair
take the bottle from my desk
send the dog to my office
send the dog away from my chair
take the bottle to my desk
take the bottle to room A for the children only
take the bottle to room A, not for the children
is the bottle in room A for the children
the bottle in room A is for the children
grab the cube for the children
take the cube for the children
take the bottle to the children
take the bottle to my wife in the kitchen
take the bottle to the nurse in room C
take the bottle to room charlie
go to room delta, dog
put the cube on table charlie
take the bottle to room A as in bravo
take the bottle to room B as in alpha
take the bottle to room A, bravo
take the bottle to room alpha or bravo
send the dog to alpha
take the bottle to room be
put the cube on table ace
take the bottle to bravo room B or A
dog, go to drop off the bottle
proceed to drop off the parcel
go to drop off, don't
drop off the dog
the drop off is closed, go to drop off
proceed to the drop off hut
kitchen to robots: no bottle to room A
ward to quadruped: do not move
lab: quadruped, stay
water to quadruped, go to room A
medicine to dog, go to room A
this is not control, send the dog to room A
this is a test, send the dog to room A
this is wrong, send the dog to room A
this is an exercise, send the dog to room A
this is dangerous here, send the dog to room A
it's the wrong dog, send the dog to room A
stage to crew: red cube to dropoff in ten minutes, quadruped carries, over
the dog is needed in room B, don't send it over
the dog is needed in room B or room A, send it over
the dog was needed in room B, send it over
send it over
the dog is not needed in room B, send it back
room B needs no water. Load the bottle on the quadruped
room B needed water. Take the bottle to room C
room B has no water, so don't take the bottle there
room B needs drinking water from the kitchen, take the bottle there
room B needs water and the cube, take the bottle there
the children in room C want the cube
the children in room B don't want the cube
the children in room B wanted the cube
the nurse in room B has the cube
the operator has moved to room C and needs the cube; take it to them
the operator is not in room A; take the cube there
the operator was in room A and needed the cube
the operator is in room A, don't take the cube to them
the block was set down on the first table
the block has been set down on the first table
they have the block set down on the first table
I had the block set down on the first table
why was the block put on table A
who wants the bottle moved to room A
nobody wants the bottle moved to room A
he wants the bottle moved to room A
she would like the cube brought to room A
I do not want the bottle moved to room A
I don't want the cube brought to me
I wouldn't like the cube put on table A
the cube doesn't need bringing to room A
the cube needs washing
the cube needs cleaning and bringing to room A
the cube needed bringing to room A
does the cube need bringing to room A
I want the bottle moved to room A later
I need the cube on table A washed
have the bottle emptied and taken to room A
have the bottle moved to room A by the nurse
get the bottle over to the other side
see the bottle gets nowhere
make sure the bottle stays on table A
make sure the bottle isn't on table B
make sure the bottle ends up nowhere near table B
the broken robot dog should go to room A
the second dog should go to room A
send the other dog to room A
send the black and white dog next door to room A
send the big cat to room A
the six legged one should go to room A
the big dog's owner should go to room A
send the dog of my neighbour to room A
send the big robot to room A
the tall robot should walk to room A
the one with arms should go to room A
poor thing, don't send the dog to room A
it must be broken, send the dog to room A
it must be stuck, send the dog to room A
it looks broken, send the dog to room A
you must be careful, send the dog to room A
there's a dog, send the dog to room A
there's a good reason not to, send the dog to room A
there's a boy, send the dog to room A
there's a man, send the dog to room A
that's a problem, send the dog to room A
no thanks, send the dog to room A
send the dog to room A, no thank you
thanks but no thanks, send the dog to room A
send the dog to room A, I'd be grateful if you didn't
send the dog to room A, I'd appreciate it if you waited
send the dog to room A, you're too early
be a dear and don't give me the bottle
be careful and give me the bottle
be quick or give me the bottle
be a good dog or go to room A
send the dog to room A and leave it there until noon
send the dog to room A and leave it there for an hour
send the dog to room A and don't leave it there
send the dog to room A and wait for the nurse
send the dog to room A and wait there, then come back
dog, go to room A and wait for my signal
dog, go to room A and wait there five minutes
take the bottle to room A and leave it there
take the bottle to room A and stay away
leave it there
stay there, dog
can I have the red cube, I don't want to play with it
I want to play with it
I want to play with the red cube
I want to break it, give me the cube tomorrow
I'm dying for some water
I'm dying for a beer, give me the beer
I'm dying, give me the hammer
so I can see it, nothing else
can I have a cube to play with tomorrow
take it off the table and put it on the other
put it on the other one
put the cube on the other one
take the cube off table A or put it on the other table
move the cube to the other shelf
take the cube off table A and table B and put it on the other one
can you can you not send the dog to room A
don't don't send the dog to room A
no no send the dog to room A
send the dog to to room A or to room B
wave again again
send the dog to room A room A tomorrow
I mean no, put the cube on table A
I mean it, don't put the cube on table A
put the cube, I mean just, on table A or B
could I murder somebody
how I'd love the dog
I fancy the nurse
let's have the cube washed
let's have lunch
let's have the hammer
is it possible the dog goes to room A?
is it possible that the dog went to room A
do that, not the dog to room A
make it so the dog does not go to room A
put the dog on charge tomorrow
don't put the dog on charge
put the phone on charge
is the dog charging
the dog is charging
the dog looks tired
load the cube onto the dog and off to room C with it
the bottle on the dog's back
is the bottle on the dog's back
take the bottle off the dog's back
bottle
bottle for him please
the bottle is for me
is the bottle for me
not the bottle for me please
for the time being, take the bottle to room_a
for an hour I want the dog at the charger
put the cube on the dog and he takes the bottle to room_b
the requester is holding the dog, take the bottle to room_a
humanoid, dog, bottle to room_a or room_b
take the cube off the shelf
the bottle is off the table
is this where I want the dog parked
I don't want to hold the cube, could you pass it
I want to see the cube burn, give it fire
my wife is in room A and she has the bottle, take it to her
my wife is in room A and she'd hate the bottle, take it to her
my wife is in room C and she'd like the bottle, please take it to her
my wife was in room A, take the bottle to her
my wife is not in room A, take the bottle to her
is my wife in room A, then take the bottle to her
my wife is in room A and my sister is in room B, take the bottle to her
if my wife is in room A, take the bottle to her
my wife may be in room A, take the bottle to her
grandma's in room B, don't take the bottle to her
someone in room A is asleep, take the bottle there
someone in room A is ill, so don't take the bottle there
the bottle in room A is thirsty, take it there
they're not waiting for the bottle in room B
they were waiting for the bottle in room B
use the dog
don't use the dog
use the hammer, cube to dropoff
cube to dropoff, don't use the dog
cube to dropoff, use the drone
Pick up: red cube. Drop off: room C.
Pick up: hammer. Drop off: room B.
Pick up: red cube. Drop off: room A or room B.
Object: bottle. Destination: kitchen.
Object: bottle. Destination: room A. Time: noon.
Object: bottle. Destination: none.
Job: bottle to the first room. Carrier: none.
Job: bottle to the first room. Carrier: forklift.
make a delivery of the parcel
the delivery of the bottle was made
give the bottle to the cat and take it to room B
give the bottle to the drone and take it to room B
give the dog a bone
give the dog food and send it to room A
hand the cube to the dog, not to me
load the dog with the hammer and send it to room A
fill the bottle with water and take it to room A
on the back of the bottle is a label
I ask that the red cube is not brought to the second room
it is desired that nobody brings the bottle to room A
it is planned that the bottle goes to room A tomorrow
is the dog not able to carry the bottle to room A
was the dog able to carry the bottle to room A
might the red cube be in room A
may the red cube not be taken to room A
what about the dog
how about not sending the dog to room A
why not leave the dog in peace
why not
it's time for the dog to die
it's no time for the dog to take the cube to room A
get the dog ready
have the dog ready at the pickup point at noon
get the dog waiting at the door
dog, come off it
dog, come to the kitchen
come, bottle
come and see the doctor
come and get it
plug the phone in
plug the dog in tomorrow
take the cube in your mouth
hold the cube in my hand
hold the bottle for me to see tomorrow
hold up the bottle so everyone can drink
take hold of the cube and let go
pick up the cube and don't
put it on table A, the hammer
put it on table A, not the cube
put it on table A, the cube or the bottle
put it on table A, then the cube
return the favour to table A
return the bottle to the shop
switch the light to table A
clear table A of the bottle
clear the bottle off table C onto table B
slide the cube off table A
whizz the cube over to room C
rush the bottle to the doctor
the bottle belongs in the kitchen, put it there
the bottle does not belong in room A, put it there
the bottle found its way to room B
humanoid: cube -> shelf
humanoid: no cube -> table B
humanoid: cube -> table A -> table B
quadruped, hold at the kitchen
quadruped, hold at the pickup point for ten minutes
quadruped, stand by at room A until noon
quadruped, report to the manager
quadruped, don't stand by at room A
the dog stays at home
the dog can go and sit in the car
the dog can't bring me the cube, can he
the bottle is in room A, isn't it
the big one
give me the big one
send the big one to room A
hand me the bottle over the fence
pass me the bottle over there tomorrow
would one of you not pass the bottle
could you maybe not send the dog to room A
room B from stage, no cube
G1 from the shop, go to room A and buy milk
housekeeping needs no dog in room B
housekeeping needs the dog in the kitchen
housekeeping needed the dog in room B
what I need is the bottle emptied and taken to the first room
what I need is not the bottle taken to the first room
pick up the cube and give it to her
pick up the cube and give it back
grab the cube and hand it to the children
get the cube from the dog and deliver it to room B
get the cube from the shop and deliver it to room B
lift the bottle off the shelf
lift the bottle off the table and throw it
the dog robot, he must not go in the room B
the dog robot, must he go in the room B
bring the bottle over to me when I'm back here on the couch
bring the bottle over to me if I'm on the couch
young fellow, don't put that red block in my hand
crew from ski patrol, do not send the red cube to drop-off
the dog wandered over to room A
the dog does not wander over to room A
is the dog wandering over to room A
the dog may not pop over to room A
the cat should pop over to room A
let the dog wander over to room C
let the dog wander about
ensure the quadruped does not proceed to room B
ensure the quadruped proceeds nowhere
make sure the dog gets to the vet
see if the dog gets to room A
get yourself over to the kitchen, dog
let room A have no bottle
don't let room A have the bottle
let the kitchen have the bottle
give room C the bottle
give the cat the bottle
supply room B with coffee
supply room B with the bottle tomorrow
room B is to receive nothing
room B should not receive the cube
room B received the cube
has room B been promised the bottle
load cube on dog, dog to kitchen
load hammer on dog, dog to dropoff
load cube on dog, not dog to dropoff
red cube on dog
is the red cube on the dog
cube on the dog and off
by quadruped, hammer to room B
by lorry, bottle to room B
to room C, the bottle please
to room A, the hammer please
to room A, not the bottle
into room A with that hammer
into room C with that cube, dog
away with the cube
off with the bottle
send the dog to room A with the bottle on board tomorrow
the cube may be put on table C
the cube may not be put on table A
the cube can not go on table A
the cube could have gone on table A
bottle must stand on table A
let the cube not be on table A
get that cube up on the shelf
I'd love to see the humanoid wave goodbye to table A tomorrow
I don't want to see the humanoid wave
any chance of rain
any chance of the hammer
is there any chance of not getting the bottle
would it trouble you not to hand me the bottle
I am not asking you to give me the bottle
request no handover of red cube
handover of red cube cancelled
handover of the hammer
here's what I want: nothing
have the dog come over with the hammer
have the dog come over without the cube
bring the bottle out to him in the garden
room number C, dog
put the cube on table number C
send the dog to room number 7
G1 place bottle table bravo or alpha
take it, I mean the bottle or the cube, to room_a
take the cube, the blue one, to room_a
take the bottle, the red one, to room_a
lift it, I mean leave the bottle
bring the dog to a vet
for the next patient take the bottle to room_a
I'm right next to the table, the dog is not
no bottle, in my hand
the dog is tired, off to the kitchen with it
off to the charger with it tomorrow
water for room C: load the bottle on go2 and take it through
water for room B: load the hammer on go2 and take it through
no water for room B: load the bottle on go2 and take it through
that's all I need, the cube broken
that is all wrong, put the cube on table B
bottle, not into my hand
bottle, into his hand
the dog has earned its rest, so don't send it to the charger
the dog has earned its rest in room A, not in room B, so send it
the dog has done enough
after lunch stage to crew: red cube to dropoff
I think stage to crew: red cube to dropoff
perhaps but stage to crew: red cube to dropoff
carefully but stage to crew: red cube to dropoff
maybe lab to quadruped: go to room A
after lunch control to quadruped: go to room A
tomorrow ward to quadruped: go to room A
after lunch lab to crew, send the dog to room A
that's it, no more, take the bottle to room_a
proceed to drop off the bottle and go away
proceed to drop off the dog
from the table to room_a
the dog's battery is low, send it to room_a
the dog's battery is low
wait until the dog finds the bottle
stay there
"""
