"""Words of the shipped crews whose slips were looked up, and slips among them that may be another word.

Made by tests/unit/contracts/language/make_slips.py; not to be edited.
"""

from crew.contracts.language.words import word_set

LOOKED_UP: frozenset[str] = word_set(
    """
    abort aborted aborting aborts advance advanced advances advancing airborne along ascend ascended ascending ascends
    askses attend attended attending attends auntie aunties aunts bearing bears block bloke blokes borne bottle bring
    bringing brings brother brothers brought buggies buggy camper campers cancel canceled canceling cancels canned
    canning canvass canvassed canvasses canvassing carried carries carry carrying casualties casualty cease ceased
    ceases ceasing chaps charger charging check checked checking checks child children childs climb climbed climber
    climbers climbing climbs colleague colleagues combed combing combs comes coming convey conveyance conveyed
    conveying conveys coordinates coordinatesed coordinateses coordinatesing copter copters could coulded coulding
    coulds cousin cousins cover covered covering covers daddies daddy daughter daughters deliver delivered delivering
    delivers delivery descend descended descending descends despatch despatched despatches despatching direct directed
    directing directs discover discovered discovering discovers dispatch dispatched dispatches dispatching doggie
    doggies doggo doggoes doggy drive driven drives driving drone drones dropoff dropped dropping drops drove eastern
    easthalf ended ending enter entered entering enters everything everywhere explore explored explores exploring
    father fathers fellow fellows fetch fetched fetches fetching field finding finds first flies flown flying found
    freeze freezes freezing friend friends froze frozen gentleman gentlemans getting girls given gives giving going
    gotten grabbed grabbing grabs grandad grandads granddad granddads granddaughter granddaughters grandfather
    grandfathers grandma grandmas grandmother grandmothers grandpa grandpas grandson grandsons grannies granny grasp
    grasped grasping grasps greet greeted greeting greets ground halted halting halts handed handing hands hauled
    hauling hauls haved haves having headed heading heads hello heres hiker hikers holding holds hover hovered
    hovering hovers humanoid humanoids husband husbands injured inspect inspected inspecting inspects jogger joggers
    keeped keeping keeps ladies landed landing lands launch launched launches launching layed laying lifted lifting
    lifts liked likes liking loaded loading loads locate located locates locating looked looking looks machine
    machines maked makes making mayed maying might mighted mighting mights missing mission mommies mommy mother
    mothers moved moves moving mummies mummy myself myselfs navigate navigated navigates navigating needed needing
    needs neighbour neighbours nephew nephews niece nieces north northern northhalf operational operationalarea
    operator operators other passed passes passing patient patients payload payloadtray people person persons picked
    picking picks pickup place placed places placing point popped popping portion position positioned positioning
    positions proceed proceeded proceeding proceeds putting quadcopter quadcopters quadrotor quadrotors quadruped
    quadrupeds quads recall recalled recalling recalls recon reconnaissance reconnoitre reconnoitred reconnoitres
    reconnoitring redcube region relocate relocated relocates relocating relocation report reported reporting reports
    requester requesters respond responded responding responds return returned returning returns right robot robots
    rooma roomb round route routed routes routing rover rovers runned runner runners running sayed saying scanned
    scanning scans scour scoured scouring scours search searched searches searching second section sector seize seized
    seizes seizing sending sends setted setting shift shifted shifting shifts sister sisters south southern southhalf
    stand standed standing stands start station still stopped stopping stops survey surveyed surveying surveys
    survivor survivors sweep sweeping sweeps swept table tablea tableb taken takeoff takeoffed takeoffing takeoffs
    takes taking telling tells through touch touched touches touching track tracked tracking tracks transfer
    transfered transfering transfers transport transportation transported transporting transports travel traveled
    traveling travels trouble turtlebot turtlebots uncle uncles units vehicle vehicles victim victims walked walker
    walkers walking walks wanted wanting wants water waved waves waving western westhalf where whoever whole wifes
    woman womans women
    """
)

DOUBTFUL: frozenset[str] = word_set(
    """
    abor abors abort abortin abot abots abrt adance advance alng alon alying anties ants aong aort ascen ascend
    ascendd askes askss asses atken atten attend attendd attende attned auns aunt auntie auts baers baring bars beaing
    bear bearrs beas beraing bering bers bggies bggy bing binging bings blck blke bllock bloc blok bloke bloks bock
    boke bone bonre bore boren born bother bothers bought brig briging brigs briing brin bring brins brne brone brothe
    brother brothes brough brring bttle bugg bugges cacel camer camers campe camper cance cancel cancelled cancelling
    cances caned canel caning caninng canne cannig canvas canvased canvases canvasess canvasing canvasse canvasss
    caper capers caps caries carr carred carres carrie carring cary casalty case cased cases casing casualy causalty
    ceaes cease ceasse chager chaging chap charer charge chargin charing chas chck chcked chcking chcks check checke
    checkeed checkin chek cheks chid chil child chilld chils chps cliber clibers clim climb climbe climber climed
    climing clims clmber cnned cnning cobs coer coered coering coers coes coing cold colds colleague colud coluded
    coluding coluds comb combe combiing combin combinng come comed coming commes coms coney coneys conve conveed
    conveing convey conveye convy convys coordinate coordinateed coordinatees coordinatess coper copers copter cosin
    coter coud couded couding couds coul could couldd couled couling couls cousin cove coveed coveing cover coves
    covey coveys crried crries crry crrying cvers dadd dadies dady daughter deliveer deliver delivere deliverr delver
    delvers descen descend descendd despatche direct directin diret direts discoveer discover discovere discoverr
    dispatche dive dives diving dogg dogge dogges doggie doggoe dogie dogies dogy done dopped dopping dops dove drie
    drien dries drive droe droes dron drone drons droopping droops drop droping droppe dros drpped drpping drps drve
    drves dspatch dspatched dspatches dspatching easter ecase ecased ecasing eded eding endd ened enter entere entr
    entre entres eter eters exploe exploed exploer exploers exploes exploing explore explorre explorres expored
    exporing fater faters father feeze feld fellow fetche fids fied fiedl fiel fieldd fiend fiends fies fild filed
    files find fining fins firs firsst firt firts fist fles flie fling flis fllies fllow fllows flon flow fnding fnds
    fond foud foun foundd fown freee freees freeing freeze freze fried friend frined frist froe froen froze frst ftch
    fund fying gabbed gabbing gabs garbs gasp gasped gasping gasps geet geets gentleman gentlemn geret gerets gien
    gies gils ging girl girlls girs give goin gong gooing grab grabbe granad granda grandad grandadd grandads grandam
    grandams grandas grandd grandda granddad granddadd granddads granddaughter grandds grandfather grandma grandmother
    grandpa grandpaa grandppa grandson grann grannie grany grap graped graping graps gras grased grasing grasp grass
    grassp grbbing grbs gree greeed greeing grees greet greete gret grete grets grils grond groundd grund gtting haded
    hading hads haed haeds haes haing haled haling hals halt halte hand handd hande haned haning hans hated hating
    hats haul hauld haule haus have head headd heade heaed heaing heas heded heding heds heers hees hell here heress
    hers herse hier hiers hike hiker hikes hllo hlts hnds hods hoer hoers hold holing hols hoover hoovered hoovering
    hoovers hove hover hoves hres huled huling huls humanoid husband hvering hves hwoever injure insect insected
    insects inspect inspectin inured jgger jogge jogger keeed keeing keep keepe kees laddies laded lades ladie lading
    lads laed laing lanch land landd lande laned laning lans launces launche layd laye layeed lfits lfts lied lies
    lift lifte liing like likeed likin liks lited liting lits lkes lnding lnds load loadd loade loaed loaing loas
    loate loated loates loating locae locaes locate locatin loded loding lods loked loking loks looed looing look
    looke loos lunch lunched lunches lunching lying machin machine maed maes maing make maks maye might mising missin
    mkes mmmies mmmy moed moes moing momm moter mother move mssing mther mumm mysel myself navigate navigatin neded
    neding neds need needd neede neeed neighbor neighbors neighbour nephew neter netered netering nice nicee nices
    niec niece northen norther noth nucle nucles oging operationall operator oter pace paced paces pacing palce palces
    pased pases pasing passe passin passs passse patent patents patient payloa pcked pcking pcks peerson peron person
    peson piced picing pick picke pickeed pics piked piking piks pint piont plaace plaaces placd place plae plaed
    plaes plaing poin poit pont poopped poopping poped poping poppe poppin portin portio porton positin position
    positon potion prceeded prceeding preson proceed proceedd proceeed prson prsons pssed psses pssing ptting puting
    puttin quad quadrupe quadruped quas quds rboot rboots rdone reall realls recal recall reconnoite reconnoiter
    reconnoiters reconnoitr reconnoitre redcue regin rellocation relocate relocatin reocation reon reort reorted
    reorting reorts repor report reporte repot requeste requester resond resonded resonding resonds respond respondd
    responde respons retun retuning return reurn reurns robot robt roer roers roma rond rooam roob room root roots
    rote roted roting roud roue roued roues rouet rouing roun roundd rout route routin routs rove rover roves rroute
    rrouted rrouting runed runer runing runne runner runnes ruted ruting rver rvers saed saing sand sanded sanding
    sands sanned sanning sans sarch sarched sart sation scan scanne scas scor scored scoring scors scou scoued scouing
    scour scoure scous sction scur scured scuring searche secondd seding sedns seds seection seector seep seeping
    seeps seie seies seize seizin send sening sens sensd sept seted seting sette shft shfted shfting shfts shift
    shifte shit shited shiting shits sift sifted sifting sifts siister sill siser sister siter siters size sized sizes
    sizing snding snds sopped sopping sops soth souht sour soured souring sours sout souther southren stad stan stand
    standd staned staning stans star stat statin staton stil stll stoopped stoopping stoops stop stoped stoping stoppe
    stpped stpping stps strat strt stted stting surey survey survivor survy swee sweep swees swep swet syed sying
    taable tabl tabla table tack tacked tacking tacks taen taes taing take takeoff takin takn taks tale tavel tell
    tels thorugh though throough tken tkes tking tlling tlls toch toched toches toching toher touche touh trac traced
    tracing track tracke tracs transfer transfere transferr transferred transferring transport transporte trave travel
    travele travelled travelling traves trck trcked trcking trcks trough tuch unce uncle unis unit unles unts vehicle
    veicle veicles victim vitim waed waer waes waing waivng waked waker wakers waking wakling waks waled waler walers
    waling walk walke walker walkes wals waned waning wans want wate wated wating watr wats wave waveed waviing were
    wester whee wheer wher whle whoe whooever whre wies wife wnted woan woen wole woman womn wooman wves
    """
)
